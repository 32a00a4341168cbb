// Everything that Assimp reads: glTF, OFF, Collada, FBX, 3DS and more.
#include <assimp/DefaultIOSystem.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "scene/importers/importer.h"
#include "scene/importers/repeated_note.h"
#include "scene/texture_file.h"

namespace boxwood {
namespace {

/// Remembers which files Assimp opens, so that the cache knows when one of them changes.
class RecordingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit RecordingFiles(std::vector<std::filesystem::path>& opened) : opened_(opened) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    Assimp::IOStream* stream = DefaultIOSystem::Open(file, mode);
    if (stream && std::find(opened_.begin(), opened_.end(), file) == opened_.end()) opened_.emplace_back(file);
    return stream;
  }

 private:
  std::vector<std::filesystem::path>& opened_;
};

Vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }
Vec3 to_vec3(const aiColor3D& c) { return {c.r, c.g, c.b}; }

Transform to_transform(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

Material to_material(const aiMaterial& from) {
  Material to;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) to.name = name.C_Str();
  const auto color = [&](const char* key, unsigned type, unsigned index, Vec3& out) {
    aiColor3D found;
    if (from.Get(key, type, index, found) == aiReturn_SUCCESS) out = to_vec3(found);
  };
  color(AI_MATKEY_COLOR_DIFFUSE, to.diffuse);
  color(AI_MATKEY_BASE_COLOR, to.diffuse);
  color(AI_MATKEY_COLOR_EMISSIVE, to.emission);
  color(AI_MATKEY_COLOR_SPECULAR, to.specular);
  from.Get(AI_MATKEY_SHININESS, to.shininess);
  float opacity = 1;
  if (from.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity >= 0 && opacity < 1) {
    to.diffuse = to.diffuse * opacity;
    to.specular = to.specular * opacity;
    to.transmission = Vec3{1, 1, 1} * (1 - opacity);
  }
  from.Get(AI_MATKEY_REFRACTI, to.refraction_index);
  return to;
}

class AssimpConverter {
 public:
  AssimpConverter(const aiScene& from, const std::string& file) : from_(from), file_(file) {}

  Scene convert() {
    if (from_.mNumMaterials > 0xffff) throw Error(fmt::format("{}: has more than 65,535 materials; merge some", file_));
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) {
      scene_.materials.push_back(to_material(*from_.mMaterials[i]));
      scene_.materials.back().texture = texture_of(*from_.mMaterials[i]);
    }
    for (unsigned i = 0; i < from_.mNumMeshes; ++i) scene_.meshes.push_back(to_mesh(*from_.mMeshes[i]));
    place(*from_.mRootNode, {}, 0);
    add_cameras();
    add_lights();
    not_triangles_.report(scene_.notes.messages);
    return std::move(scene_);
  }

 private:
  /// The base colour's or the diffuse one, from a file or from within this one.
  std::uint32_t texture_of(const aiMaterial& material) {
    aiString name;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) {
      return Material::no_texture;
    }
    const aiTexture* embedded = from_.GetEmbeddedTexture(name.C_Str());
    if (!embedded) {
      std::string portable = name.C_Str();
      std::ranges::replace(portable, '\\', '/');
      return add_texture(scene_, std::filesystem::path(file_).parent_path() / portable);
    }
    const auto known = embedded_.find(embedded);
    if (known != embedded_.end()) return known->second;
    std::uint32_t number = Material::no_texture;
    if (embedded->mHeight == 0) {  // compressed: mWidth bytes
      try {
        const std::span bytes(reinterpret_cast<const std::byte*>(embedded->pcData), embedded->mWidth);
        scene_.textures.push_back(decode_texture(bytes, file_ + ", texture " + name.C_Str()));
        number = static_cast<std::uint32_t>(scene_.textures.size() - 1);
      } catch (const Error& error) {
        scene_.notes.messages.emplace_back(error.what());
      }
    }
    return embedded_[embedded] = number;
  }

  Mesh to_mesh(const aiMesh& from) {
    Mesh to;
    to.name = from.mName.C_Str();
    const std::size_t vertices = from.mNumVertices;
    to.positions.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) to.positions.push_back(to_vec3(from.mVertices[i]));
    if (from.HasNormals()) {
      for (std::size_t i = 0; i < vertices; ++i) to.normals.push_back(to_vec3(from.mNormals[i]));
    }
    if (from.HasTextureCoords(0)) {
      for (std::size_t i = 0; i < vertices; ++i) {
        to.texture_coordinates.push_back({from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y});
      }
    }
    to.triangles.reserve(from.mNumFaces);
    for (unsigned i = 0; i < from.mNumFaces; ++i) add_face(to, from.mFaces[i]);
    if (from.mMaterialIndex < scene_.materials.size()) {
      to.materials.assign(to.triangles.size(), static_cast<std::uint16_t>(from.mMaterialIndex));
    }
    return to;
  }

  void add_face(Mesh& mesh, const aiFace& face) {
    if (face.mNumIndices != 3) {
      return not_triangles_.add([&] {
        return fmt::format("{}: mesh '{}' has points or lines, which are not faces; they were skipped", file_,
                           mesh.name);
      });
    }
    for (unsigned corner = 0; corner < 3; ++corner) {
      if (face.mIndices[corner] < mesh.positions.size()) continue;
      throw Error(fmt::format("{}: triangle {} of mesh '{}' refers to vertex {} of {}; mend or remove it", file_,
                              mesh.triangles.size(), mesh.name, face.mIndices[corner], mesh.positions.size()));
    }
    mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }

  void place(const aiNode& node, const Transform& parent, int depth) {
    if (depth > 1'000) throw Error(fmt::format("{}: nodes are nested more than 1,000 deep; flatten them", file_));
    const Transform to_world = parent * to_transform(node.mTransformation);
    nodes_.emplace_back(node.mName.C_Str(), to_world);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) scene_.instances.push_back({node.mMeshes[i], to_world});
    for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], to_world, depth + 1);
  }

  /// Cameras and lights stand in the node of their name.
  Transform transform_of(const aiString& name) const {
    for (const auto& [node, transform] : nodes_) {
      if (node == name.C_Str()) return transform;
    }
    return {};
  }

  void add_cameras() {
    // Assimp repeats the translation of a glTF camera's node as the camera's own position.
    const bool is_gltf = file_.ends_with("gltf") || file_.ends_with("glb");
    for (unsigned i = 0; i < from_.mNumCameras; ++i) {
      const aiCamera& camera = *from_.mCameras[i];
      const Transform to_world = transform_of(camera.mName);
      const float horizontal = camera.mHorizontalFOV * 180 / std::numbers::pi_v<float>;
      const float fov = camera.mAspect > 1 ? horizontal / camera.mAspect : horizontal;
      const Vec3 direction = to_world.vector(to_vec3(camera.mLookAt));
      if (!(is_finite(direction) && length(direction) > 0 && fov > 0 && fov < 180)) continue;
      scene_.cameras.push_back({camera.mName.C_Str(), to_world.point(is_gltf ? Vec3{} : to_vec3(camera.mPosition)),
                                direction, to_world.vector(to_vec3(camera.mUp)), fov});
    }
  }

  void add_lights() {
    for (unsigned i = 0; i < from_.mNumLights; ++i) {
      const aiLight& from = *from_.mLights[i];
      const Transform to_world = transform_of(from.mName);
      Light light;
      light.position = to_world.point(to_vec3(from.mPosition));
      light.intensity = to_vec3(from.mColorDiffuse);
      light.direction = normalize(to_world.vector(to_vec3(from.mDirection)));
      if (from.mType == aiLightSource_DIRECTIONAL) {
        light.kind = LightKind::distant;
      } else if (from.mType == aiLightSource_SPOT) {
        light.kind = LightKind::spot;
        light.full_cosine = std::cos(from.mAngleInnerCone);
        light.dark_cosine = std::cos(from.mAngleOuterCone);
      } else if (from.mType != aiLightSource_POINT) {
        continue;
      }
      scene_.lights.push_back(light);
    }
  }

  const aiScene& from_;
  const std::string& file_;
  Scene scene_;
  std::vector<std::pair<std::string, Transform>> nodes_;
  RepeatedNote not_triangles_;
  std::map<const aiTexture*, std::uint32_t> embedded_;  ///< numbers of those that were decoded
};

}  // namespace

Imported import_with_assimp(const std::filesystem::path& file) {
  const std::string name = file.string();
  Imported imported{{}, {file}};
  Assimp::Importer importer;
  importer.SetIOHandler(new RecordingFiles(imported.files));  // the importer frees it
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    std::string why = importer.GetErrorString();
    while (!why.empty() && (why.back() == '.' || why.back() == '\n')) why.pop_back();
    throw Error(fmt::format("{}: cannot be read ({}); check that it is complete, or get it again", name, why));
  }
  imported.scene = AssimpConverter(*scene, name).convert();
  return imported;
}

}  // namespace boxwood
