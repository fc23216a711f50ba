#include <camber/basis/lattice.hpp>
#include <camber/validity/detail/determinant_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace camber::detail {

namespace {

int pass_size(const FactorPass& pass) {
  return static_cast<int>(pass.matrix.rows()) * pass.inner * pass.outer;
}

// Largest sum of magnitudes of a row: how much a linear map can amplify an error.
double amplification(const MatX& M) { return M.cwiseAbs().rowwise().sum().maxCoeff(); }

// Scratch of one volume or area determinant, in values a lane.
int determinant_work(const KernelPlan& plan) {
  int work = 3 * plan.cross.size + plan.size;
  for (int c = 0; c < plan.columns; ++c) {
    const ColumnView& column = plan.column[c];
    int room = column.differences;
    for (int p = 0; p < column.pass_count; ++p) {
      const PassView& pass = column.passes[p];
      room = std::max(room, pass.rows * pass.inner * pass.outer);
    }
    work += 6 * room;
  }
  return work;
}

}  // namespace

const double* DeterminantPlan::keep(std::vector<double> values) {
  return doubles_.emplace_back(std::move(values)).data();
}

const std::int32_t* DeterminantPlan::keep(std::vector<std::int32_t> values) {
  return integers_.emplace_back(std::move(values)).data();
}

const PassView* DeterminantPlan::keep(const std::vector<FactorPass>& passes) {
  std::vector<PassView>& views = passes_.emplace_back();
  for (const FactorPass& pass : passes) {
    const auto rows = pass.matrix.rows(), columns = pass.matrix.cols();
    std::vector<double> by_row;
    for (Eigen::Index r = 0; r < rows; ++r) {
      for (Eigen::Index c = 0; c < columns; ++c) by_row.push_back(pass.matrix(r, c));
    }
    views.push_back({keep(std::move(by_row)), static_cast<int>(rows), static_cast<int>(columns),
                     pass.inner, pass.outer});
  }
  return views.data();
}

ProductView DeterminantPlan::product(const CoefficientSpace& a, const CoefficientSpace& b) {
  ProductView view;
  const std::vector<CoefficientRow>& rows_a = rows_.emplace_back(coefficient_rows(a));
  const std::vector<CoefficientRow>& rows_b = rows_.emplace_back(coefficient_rows(b));
  view.a = rows_a.data();
  view.b = rows_b.data();
  view.a_rows = static_cast<int>(rows_a.size());
  view.b_rows = static_cast<int>(rows_b.size());
  view.out = keep(product_rows(a, b));
  view.size = product_space(a, b).size();
  return view;
}

ColumnView DeterminantPlan::pack(const ColumnTable& table) {
  ColumnView view;
  view.from = keep(table.from);
  view.to = keep(table.to);
  view.differences = static_cast<int>(table.from.size());
  view.size = table.space.size();
  double amplified = 1.0, roundings = 2.0;  // the difference, the entries of the matrices
  for (const FactorPass& pass : table.passes) {
    amplified *= amplification(pass.matrix);
    roundings += 2.0 + static_cast<double>(pass.matrix.cols());
  }
  view.rounding = amplified * roundings;

  // The scaling of factor f goes into the pass that makes factor f: passes and factors correspond,
  // or there is one pass for everything.
  std::vector<FactorPass> scaled = table.passes;
  const std::vector<double> all = multinomials(table.space);
  if (scaled.size() == 1) {
    MatX& M = scaled.front().matrix;
    for (Eigen::Index r = 0; r < M.rows(); ++r) M.row(r) *= all[static_cast<std::size_t>(r)];
  } else {
    for (std::size_t f = 0; f < scaled.size(); ++f) {
      const std::vector<double> own = multinomials({{table.space.factors[f]}});
      MatX& M = scaled[f].matrix;
      for (Eigen::Index r = 0; r < M.rows(); ++r) M.row(r) *= own[static_cast<std::size_t>(r)];
    }
  }
  view.passes = keep(scaled);
  view.pass_count = static_cast<int>(scaled.size());
  std::vector<double> inverse;
  for (double m : all) inverse.push_back(1.0 / m);
  view.inverse_multinomial = keep(std::move(inverse));
  return view;
}

DeterminantPlan::DeterminantPlan(Shape shape, int p) {
  const std::vector<ColumnTable> columns =
      shape == Shape::pyramid ? pyramid_columns(p) : tensor_columns(shape, p);
  kernel_.nodes = node_count(shape, p);
  kernel_.columns = static_cast<int>(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) kernel_.column[c] = pack(columns[c]);

  // A face's third column is the normal of the straight face, a product of its first-order columns.
  CoefficientSpace last;
  if (columns.size() == 3) {
    last = columns[2].space;
  } else {
    const std::vector<ColumnTable> straight = tensor_columns(shape, 1);
    last = product_space(straight[0].space, straight[1].space);
  }
  const CoefficientSpace area = product_space(columns[0].space, columns[1].space);
  kernel_.cross = product(columns[0].space, columns[1].space);
  kernel_.dot = product(area, last);
  space_ = product_space(area, last);
  kernel_.size = space_.size();

  std::vector<double> inverse;
  for (double m : multinomials(space_)) inverse.push_back(1.0 / m);
  kernel_.inverse_multinomial = keep(std::move(inverse));
  std::vector<std::int32_t> corner;
  for (const CornerCoefficient& c : corner_coefficients(space_)) corner.push_back(c.coefficient);
  kernel_.corners = static_cast<int>(corner.size());
  kernel_.corner = keep(std::move(corner));

  // Longest sums: every coefficient collects at most min(sizes) products; 64 as a floor for
  // comfort.
  const int first = std::min(columns[0].space.size(), columns[1].space.size());
  const int second = std::min(area.size(), last.size());
  kernel_.rounding = std::max(64.0, 2.0 * first + 3.0 * second + 16.0);

  subdivision_ = SubdivisionTable(shape, space_);
  link_straight(shape, p);
}

void DeterminantPlan::link_straight(Shape shape, int p) {
  kernel_.work = determinant_work(kernel_);
  const DeterminantPlan* linear = p == 1 ? this : &of(shape, 1);
  straight_.plan = &linear->kernel_;

  const LatticeMap& linear_map = lattice_map(shape, 1);
  const LatticeMap& map = lattice_map(shape, p);
  std::vector<std::int32_t> corner_node(map.corner.size());
  for (std::size_t c = 0; c < map.corner.size(); ++c) {
    corner_node[static_cast<std::size_t>(linear_map.corner[c])] = map.corner[c];
  }
  straight_.corner_node = keep(std::move(corner_node));

  std::vector<FactorPass> passes;
  CoefficientSpace now = linear->space_;
  int work = now.size();
  for (std::size_t f = 0; f < now.factors.size(); ++f) {
    const Factor from = now.factors[f], to = space_.factors[f];
    if (from.degree == to.degree) continue;
    FactorPass pass;
    pass.matrix = factor_elevation(from, to);
    pass.inner = now.stride(static_cast<int>(f));
    pass.outer = now.size() / (pass.inner * from.size());
    now.factors[f] = to;
    work = std::max(work, pass_size(pass));
    passes.push_back(std::move(pass));
  }
  straight_.passes = keep(passes);
  straight_.pass_count = static_cast<int>(passes.size());
  straight_.work = work;
  work_ = kernel_.work + linear->kernel_.work + 2 * work + 3 * linear->kernel_.nodes;
}

const DeterminantPlan& DeterminantPlan::of(Shape shape, int p) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const DeterminantPlan> plan;
  };
  static std::array<std::array<Slot, k_max_certified_order + 1>, k_shape_count> slots;
  if (p < 1 || p > k_max_certified_order || dimension(shape) < 2) {
    throw std::invalid_argument("no certificate for a " + std::string(name(shape)) + " of order " +
                                std::to_string(p));
  }
  Slot& slot = slots[static_cast<std::size_t>(shape)][static_cast<std::size_t>(p)];
  std::call_once(slot.once, [&] { slot.plan = std::make_unique<const DeterminantPlan>(shape, p); });
  return *slot.plan;
}

}  // namespace camber::detail
