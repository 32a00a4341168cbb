#pragma once
#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "boxwood/ray.h"

namespace boxwood {

/// A reference to an object (a lambda, not a plain function) that is asked about a hit and says whether it counts:
/// `bool(const Hit&)` or, in batches, `bool(std::size_t ray, const Hit&)`. Refers to the callable it is made from,
/// which must outlive the query; one that is passed as a temporary does. What the callable throws ends the query.
class HitFilter {
 public:
  template <class Accept>
  requires(std::is_object_v<std::remove_reference_t<Accept>> && !std::same_as<std::remove_cvref_t<Accept>, HitFilter> &&
           (std::predicate<Accept&, const Hit&> || std::predicate<Accept&, std::size_t, const Hit&>))
      HitFilter(Accept&& accept)  // NOLINT(bugprone-forwarding-reference-overload): never a HitFilter, see above
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(accept)))),
        call_([](void* object, std::size_t ray, const Hit& hit) -> bool {
          auto& callable = *static_cast<std::remove_reference_t<Accept>*>(object);
          if constexpr (std::predicate<Accept&, std::size_t, const Hit&>) {
            return callable(ray, hit);
          } else {
            return callable(hit);
          }
        }) {}

  bool operator()(std::size_t ray, const Hit& hit) const { return call_(object_, ray, hit); }

 private:
  void* object_;
  bool (*call_)(void* object, std::size_t ray, const Hit& hit);
};

}  // namespace boxwood
