#pragma once
// Certificates of many elements: in parallel, and several at once in the lanes of the processor.
#include <camber/validity/element_validity.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace camber {

struct ElementKind {
  Shape shape = Shape::tetrahedron;
  int order = 1;
};

/// Fills `nodes` with the canonical nodes of element i and says what it is. Called once per
/// element, from several threads at once; `nodes` keeps its capacity from call to call.
using GatherNodes = std::function<ElementKind(std::size_t i, Points& nodes)>;

/// certify() for elements 0..n-1 (volume shapes). Every result has the same bits as certify() gives
/// for the element alone, whatever the number of threads. Exceptions of `gather` and those of
/// certify() are rethrown after all threads have finished.
[[nodiscard]] std::vector<JacobianBounds> certify_all(std::size_t n, const GatherNodes& gather,
                                                      const CertifyOptions& options = {});

/// quick_verdict() for elements 0..n-1.
[[nodiscard]] std::vector<Verdict> quick_verdicts(std::size_t n, const GatherNodes& gather,
                                                  const CertifyOptions& options = {});

}  // namespace camber
