#pragma once
// From what a kernel found for one element to its JacobianBounds.
#include <camber/validity/detail/determinant_plan.hpp>
#include <camber/validity/detail/refine.hpp>
#include <camber/validity/element_validity.hpp>

#include <span>
#include <vector>

namespace camber::detail {

/// Doubles aligned for the widest kernel; grows, never shrinks.
class AlignedBuffer {
 public:
  [[nodiscard]] double* of(std::size_t size);

 private:
  std::vector<double> storage_;
};

/// Work of one thread.
struct ElementWork {
  AlignedBuffer nodes, scratch, output;
  std::vector<double> curved, straight, negated;  // coefficients of one lane
  RefineWork refine;
};
[[nodiscard]] ElementWork& element_work();

/// One kernel call's results, for `lanes` elements of one plan.
class KernelRun {
 public:
  /// Room for the nodes: [component][node][lane].
  static double* node_buffer(const DeterminantPlan& plan, int lanes, ElementWork& work);
  KernelRun(const DeterminantPlan& plan, KernelChoice kernel, bool with_straight,
            ElementWork& work);

  [[nodiscard]] double lowest(int lane) const { return out_.lowest[lane]; }
  [[nodiscard]] double highest(int lane) const { return out_.highest[lane]; }
  [[nodiscard]] double corner_lowest(int lane) const { return out_.corner_lowest[lane]; }
  [[nodiscard]] double corner_highest(int lane) const { return out_.corner_highest[lane]; }
  [[nodiscard]] double margin(int lane) const { return out_.margin[lane]; }
  [[nodiscard]] double straight_margin(int lane) const { return out_.straight_margin[lane]; }
  [[nodiscard]] double ratio_lowest(int lane) const { return out_.ratio_lowest[lane]; }
  [[nodiscard]] double ratio_corner(int lane) const { return out_.ratio_corner[lane]; }
  [[nodiscard]] bool is_finite(int lane) const { return out_.finite[lane] == 0.0; }
  /// Coefficients of one lane, contiguous; the array lives in `work` until the next call.
  [[nodiscard]] const double* curved(int lane, ElementWork& work) const;
  [[nodiscard]] const double* straight(int lane, ElementWork& work) const;
  [[nodiscard]] const DeterminantPlan& plan() const { return plan_; }

 private:
  const DeterminantPlan& plan_;
  int lanes_;
  KernelOutput out_;
};

/// Bounds of a volume element; order p.
[[nodiscard]] JacobianBounds volume_bounds(const KernelRun& run, int lane, int p,
                                           const CertifyOptions& options, ElementWork& work);
/// Only its verdict.
[[nodiscard]] Verdict volume_verdict(const KernelRun& run, int lane, const CertifyOptions& options,
                                     ElementWork& work);
/// Bounds of a boundary face.
[[nodiscard]] JacobianBounds face_bounds(const KernelRun& run, int lane,
                                         const CertifyOptions& options, ElementWork& work);

}  // namespace camber::detail
