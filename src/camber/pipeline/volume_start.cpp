#include <camber/elevate/apply_field.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/pipeline/volume_start.hpp>
#include <camber/smooth/patch.hpp>

#include <algorithm>
#include <utility>

namespace camber {
namespace {

/// Share of the curved cells from which on a start other than the paper's counts as tangled as a
/// whole; below it, it is a matter for single patches.
constexpr double k_tangled_share = 0.25;

/// A carried state may have this many times the uncertified cells of an elastic one and still be
/// the better start: what is left of it is local, on folded wall faces.
constexpr std::size_t k_carried_advantage = 10;

}  // namespace

std::string_view name(Propagation propagation) {
  switch (propagation) {
    case Propagation::elastic:
      return "elastic";
    case Propagation::cell:
      return "cell";
    case Propagation::layer:
      break;
  }
  return "layer";
}

void add_work(const ElasticWork& more, ElasticWork& work) {
  work.solves += more.solves;
  work.unconverged += more.unconverged;
  work.products += more.products;
  work.largest_residual = std::max(work.largest_residual, more.largest_residual);
}

void add_solve(const ElasticResult& solve, ElasticWork& work) {
  add_work(
      {1, solve.is_converged ? 0U : 1U, static_cast<std::size_t>(solve.products), solve.residual},
      work);
}

VolumeStart::VolumeStart(CurvedMesh& curved, const LayerField& asked, const LayerField& layers,
                         Propagation propagation)
    : curved_(curved), field_(asked), layers_(layers), asked_(propagation), taken_(propagation) {
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) {
    if (curved.cell_order(c) > 1) curved_cells_.push_back(c);
  }
}

ElasticResult VolumeStart::relax(CurvedMesh& curved) {
  const ElasticResult solve = relax_elastic(curved, curved_cells_, free_nodes(curved));
  add_solve(solve, elastic_);
  return solve;
}

void VolumeStart::propagate() {
  apply_field(field_, curved_);
  if (asked_ == Propagation::elastic) relax(curved_);
}

void VolumeStart::certify() {
  uncertified_ = uncertified_cells(curved_, curved_cells_);
  uncertified_as_asked_ = uncertified_.size();
}

bool VolumeStart::is_tangled() const {
  if (uncertified_.empty()) return false;
  return asked_ == Propagation::cell ||
         static_cast<double>(uncertified_.size()) >
             k_tangled_share * static_cast<double>(curved_cells_.size());
}

bool VolumeStart::offer(Propagation start, CurvedMesh state, std::size_t advantage) {
  std::vector<Index> still = uncertified_cells(state, curved_cells_);
  if (still.size() >= advantage * uncertified_.size()) return false;
  curved_ = std::move(state);
  uncertified_ = std::move(still);
  taken_ = start;
  return true;
}

void VolumeStart::replace() {
  CurvedMesh relaxed = curved_;
  relax(relaxed);
  offer(Propagation::elastic, std::move(relaxed), 1);
  if (uncertified_.empty()) return;
  CurvedMesh carried = curved_;
  apply_field(layers_, carried);
  offer(Propagation::layer, std::move(carried), k_carried_advantage);
}

std::vector<Index> VolumeStart::carry(const std::vector<Index>& cells) {
  apply_field(layers_, curved_, cells);
  if (taken_ != Propagation::elastic) return cells;
  relax(curved_);
  return curved_cells_;
}

StartReport VolumeStart::report() const {
  return {std::string(name(asked_)), std::string(name(taken_)), uncertified_as_asked_,
          uncertified_.size(), elastic_};
}

}  // namespace camber
