#pragma once
// How the wall's displacement first reaches the volume, and what replaces that start if it is
// tangled.
#include <camber/elevate/layer_field.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/pipeline/report.hpp>
#include <camber/smooth/elastic.hpp>

#include <string_view>
#include <vector>

namespace camber {

/// "layer", "elastic" or "cell", as --propagate names them.
[[nodiscard]] std::string_view name(Propagation propagation);

/// Adds the work of some solves, or one solve, to that of a run.
void add_work(const ElasticWork& more, ElasticWork& work);
void add_solve(const ElasticResult& solve, ElasticWork& work);

/// The start asked for, certified; replaced where it is tangled; repeated where the wall changes.
class VolumeStart {
 public:
  /// @param asked   field of the propagation asked for: the cells' own with Propagation::cell
  /// @param layers  field through the whole boundary layer
  VolumeStart(CurvedMesh& curved, const LayerField& asked, const LayerField& layers,
              Propagation propagation);

  void propagate();
  void certify();

  /// True if the start is worth nothing beyond the wall's displacement: cells of the paper's
  /// transfer are inverted, or more than a quarter of those of another start.
  [[nodiscard]] bool is_tangled() const;
  /// Spreads the wall's displacement by one linear solve, and where cells are left uncertified
  /// carries it through the layers instead; keeps the better one.
  void replace();

  /// Carries the wall's displacement, as it is now, to the given cells again, by what start was
  /// taken; returns all cells that it may have changed, sorted.
  std::vector<Index> carry(const std::vector<Index>& cells);

  [[nodiscard]] const std::vector<Index>& uncertified() const { return uncertified_; }
  /// For Report::start.
  [[nodiscard]] StartReport report() const;

 private:
  ElasticResult relax(CurvedMesh& curved);
  bool offer(Propagation start, CurvedMesh state, std::size_t advantage);

  CurvedMesh& curved_;
  const LayerField& field_;
  const LayerField& layers_;
  Propagation asked_, taken_;
  std::vector<Index> curved_cells_;
  std::vector<Index> uncertified_;
  std::size_t uncertified_as_asked_ = 0;
  ElasticWork elastic_;
};

}  // namespace camber
