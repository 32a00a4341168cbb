#pragma once
#include <cstdint>
#include <span>

namespace boxwood::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Feeds bytes to one reader. Refusing them by boxwood::Error is right; anything else that goes wrong ends the program:
/// another exception, a wrong answer (see require()), what a sanitizer finds.
struct Target {
  const char* name;
  void (*run)(Bytes bytes);
};

/// One line per target.
std::span<const Target> targets();
/// Null when there is none of that name.
const Target* find_target(const char* name);

// Importers: the bytes are a file with the name's ending. What is read is also built and traced when it is small.
void read_ply_file(Bytes bytes);
void read_obj_file(Bytes bytes);
void read_mtl_file(Bytes bytes);
void read_stl_file(Bytes bytes);
void read_pbrt_file(Bytes bytes);
/// The scene's part of an entry of the mesh cache, before its checksum.
void read_cache_entry(Bytes bytes);
void read_camera_sidecar(Bytes bytes);
/// Everything before the checksum.
void read_ray_sets(Bytes bytes);
/// A whole file; its checksums hardly ever fit.
void read_saved_file(Bytes bytes);
/// Byte 0: which of a few structures; byte 1: which of its sections; then patches of four bytes: where (16 bits), and
/// what is laid over it (16 bits). Checksums are made right.
void read_patched_structure(Bytes bytes);
void parse_a_recipe(Bytes bytes);
void parse_a_study(Bytes bytes);
/// Byte 0: which recipe; byte 1: how many triangles; then their floats, then rays of eight floats. Every query of what
/// is built must give what testing every triangle gives.
void trace_geometry(Bytes bytes);

}  // namespace boxwood::fuzz
