#pragma once
#include <mutex>

namespace camber::io {

/// HDF5 is one state for the whole process, and most builds of it are not made for threads: who
/// calls it, or a library on top of it, holds this.
[[nodiscard]] inline std::mutex& hdf5_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace camber::io
