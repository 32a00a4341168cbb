#pragma once
#include <stdexcept>
#include <string>

namespace boxwood {

/// Anything the library cannot do, as one sentence that says what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A request that is wrong in itself (an unknown recipe stage, an option out of range), whatever the data.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace boxwood
