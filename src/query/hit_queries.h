#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "boxwood/hit_filter.h"
#include "layout/layout.h"

namespace boxwood {

/// Appends every hit of the ray to `hits`, in order, each once. O(h log h) for the h triangles found, on top of the
/// walk.
void append_all_hits(const Layout& layout, const Ray& ray, std::uint32_t mask, std::vector<Hit>& hits);

/// Fills `hits` with the ray's first hits, in order, each once, and returns how many there are. O(k) per hit found that
/// is among the first k so far.
std::size_t first_hits(const Layout& layout, const Ray& ray, std::uint32_t mask, std::span<Hit> hits);

/// The first hit that `accept` takes, from `first` on, which is the ray's closest one. It is asked about hits in order,
/// each once, and about none after the one it takes.
Hit first_accepted(const Layout& layout, const Ray& ray, std::uint32_t mask, std::size_t number, const Hit& first,
                   HitFilter accept);

}  // namespace boxwood
