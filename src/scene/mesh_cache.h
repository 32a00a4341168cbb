#pragma once
#include <filesystem>
#include <optional>
#include <span>

#include "boxwood/scene.h"

namespace boxwood {

// Imported scenes, kept in a compact binary form so that a large file loads fast the second time. Entries live in
// $BOXWOOD_CACHE, else $XDG_CACHE_HOME/boxwood, else ~/.cache/boxwood; BOXWOOD_CACHE=off turns the cache off. It never
// changes a result: what cannot be read back whole is imported again, what cannot be written is not kept.

/// Scenes whose files are smaller together import fast enough.
inline constexpr std::uintmax_t smallest_cached_file = 4u << 20;

/// The scene imported from `file` earlier; nothing when there is none, a file that it was made from has changed since
/// (by size or time), or the entry is damaged. Every size is checked before memory is taken.
std::optional<Scene> read_cached(const std::filesystem::path& file);

/// Keeps `scene`, made from `sources`, the first of which names the entry. Never throws for want of space or
/// permission.
void write_cached(const Scene& scene, std::span<const std::filesystem::path> sources);

/// Where the entry of `file` is or would be; empty when the cache is off or has no place.
std::filesystem::path cache_entry(const std::filesystem::path& file);

}  // namespace boxwood
