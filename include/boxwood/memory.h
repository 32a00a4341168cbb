#pragma once

namespace boxwood {

/// Builds keep up to 256 MiB of the memory they worked in, so that the next one need not ask the system for it, and so
/// do structures that are freed. This gives the system back what is not in use. Thread safe.
void release_kept_memory() noexcept;

}  // namespace boxwood
