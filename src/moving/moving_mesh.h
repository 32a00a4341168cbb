#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "boxwood/moving.h"
#include "layout/layout.h"
#include "moving/part_accounts.h"
#include "structure/pipeline.h"
#include "tree/parts.h"
#include "tree/tree.h"

namespace boxwood {

/// One mesh of a scene that moves: its tree, its layout and what refitting has cost. Refers to the scene and the
/// recipe.
class MovingMesh {
 public:
  MovingMesh(const Scene& scene, std::uint32_t mesh, const Recipe& recipe);

  enum class Done : std::uint8_t { refitted, rebuilt_in_part, rebuilt };
  struct Update {
    Done done = Done::refitted;
    std::uint64_t rebuilt_triangles = 0;
    std::string reason;
  };
  /// After the mesh's vertices moved. In place when nobody else holds the layout. Parallel.
  Update update(const MotionPolicy& policy);

  const std::shared_ptr<const Layout>& layout() const { return layout_; }
  Box bounds() const { return tree_.empty() ? Box{} : tree_.nodes[0].bounds; }
  std::size_t triangles() const { return tree_.references.size(); }
  std::size_t nodes() const { return tree_.nodes.size(); }
  std::size_t left_out() const { return left_out_.size(); }
  double sah_cost() const;
  std::string why_no_refit() const;
  MotionQuality quality() const;

 private:
  const Mesh& mesh() const { return scene_.meshes[number_]; }
  void build();
  void start_parts();
  void find_parts();
  bool refit_tree(PartCosts& costs);
  bool some_come_back() const;
  bool rebuild(const DueParts& due);
  void encode();
  void encode_in_place();
  std::vector<double> areas() const;
  Box box_of(std::uint32_t triangle) const;

  const Scene& scene_;  // not the mesh: meshes may be added
  std::uint32_t number_;
  Pipeline pipeline_;
  std::uint32_t arity_;
  Tree tree_;
  std::shared_ptr<const Layout> layout_;
  std::vector<std::uint32_t> left_out_;    ///< triangles that were not usable
  TreeParts parts_;                        ///< parts_.parts[p] is part p, whatever happened to the tree
  std::vector<std::uint32_t> part_of_;     ///< per triangle
  std::vector<std::uint32_t> references_;  ///< per part
  PartAccounts accounts_;
  double overlap_when_built_ = 0;
};

}  // namespace boxwood
