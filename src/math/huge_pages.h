#pragma once
#include <cstddef>

namespace boxwood {

/// Asks the system to back [begin, begin + bytes) with huge pages, where that is known and the range is large enough to
/// pay. To be called before the memory is first touched: first touches of small pages cost more than writing them. No
/// effect on what the memory holds.
void prefer_huge_pages(void* begin, std::size_t bytes);

}  // namespace boxwood
