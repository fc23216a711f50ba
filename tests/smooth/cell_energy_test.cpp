#include <camber/base/parallel.hpp>
#include <camber/base/processor.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/dual/dual.hpp>
#include <camber/dual/scalar.hpp>
#include <camber/smooth/detail/cell_energy.hpp>
#include <camber/smooth/detail/group_solver.hpp>
#include <camber/smooth/distortion.hpp>
#include <camber/smooth/elastic.hpp>
#include <camber/smooth/patch.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

using detail::CellEnergy;
using detail::EnergyKind;
using detail::EnergyPlan;
using testing::cube_mesh;
using testing::random_orders;
using testing::shake;

constexpr Shape k_volumes[] = {Shape::tetrahedron, Shape::pyramid, Shape::prism, Shape::hexahedron};

/// Written plainly from the formulas, for doubles and dual numbers.
template <Scalar T>
T naive_sample(EnergyKind kind, const Mat<T, 3>& M, double delta) {
  using std::pow;
  using std::sqrt;
  const T det = M.determinant();
  T a(0.0), b(0.0);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      a += M(i, j) * M(i, j);
      const int p = (i + 1) % 3, q = (i + 2) % 3, r = (j + 1) % 3, s = (j + 2) % 3;
      const T c = M(p, r) * M(q, s) - M(p, s) * M(q, r);
      b += c * c;
    }
  }
  if (kind == EnergyKind::metric) return a;
  if (kind == EnergyKind::shape) {
    const T h = T(0.5) * (det + sqrt(det * det + T(4.0 * delta * delta)));
    return a * b / (T(9.0) * h * h) * T(0.5) * (h + T(1.0) / h);
  }
  const T m = det < T(1.0) ? T(1.0) / det - T(1.0) : T(0.0);
  const T E = sqrt(a * b) / (T(3.0) * det) * (T(1.0) + m * m);
  return E * E * E * E;
}

template <Scalar T>
T naive_energy(EnergyKind kind, const EnergyPlan& plan, const std::vector<Vec<T, 3>>& nodes,
               std::span<const Vec3> corners, double delta) {
  std::vector<Vec3> dN(nodes.size()), linear(corners.size());
  T sum(0.0);
  for (std::size_t s = 0; s < plan.points().size(); ++s) {
    lagrange_gradients(plan.shape(), plan.order(), plan.points()[s], dN);
    lagrange_gradients(plan.shape(), 1, plan.points()[s], linear);
    Mat3 W = Mat3::Zero();
    for (std::size_t c = 0; c < corners.size(); ++c) {
      W += corners[c] *
           linear[static_cast<std::size_t>(lattice_map(plan.shape(), 1).corner[c])].transpose();
    }
    Mat<T, 3> A;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        A(i, j) = T(0.0);
        for (std::size_t n = 0; n < nodes.size(); ++n) A(i, j) += nodes[n](i) * T(dN[n][j]);
      }
    }
    const Mat3 W_inverse = W.inverse();
    Mat<T, 3> M;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        M(i, j) = T(0.0);
        for (int k = 0; k < 3; ++k) M(i, j) += A(i, k) * T(W_inverse(k, j));
      }
    }
    sum += T(plan.weights()[s]) * naive_sample<T>(kind, M, delta);
  }
  return sum;
}

/// A slightly sheared straight element with nodes shaken by a share of its node spacing.
struct Element {
  std::vector<Vec3> corner;
  Points nodes;
  Element(Shape shape, int order, double amplitude, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Mat3 A = Mat3::Identity();
    for (int i = 0; i < 9; ++i) A(i / 3, i % 3) += 0.2 * uniform(random);
    for (const Vec3& x : corners(shape)) corner.emplace_back(A * x);
    nodes = straight_nodes(shape, order, corner);
    for (Vec3& x : nodes) {
      x += amplitude / order * Vec3(uniform(random), uniform(random), uniform(random));
    }
  }
};

struct KernelResult {
  double energy, least;
  Points slope;
};
KernelResult run_kernel(EnergyKind kind, const EnergyPlan& plan, const Element& element,
                        double delta, int lanes) {
  const std::size_t n = element.nodes.size(), c = element.corner.size(),
                    w = static_cast<std::size_t>(lanes);
  std::vector<double> storage((6 * n + 3 * c + 3) * w + 8);
  double* next = storage.data();
  while (reinterpret_cast<std::uintptr_t>(next) % 64 != 0) ++next;
  double *x = next, *slope = x + 3 * n * w, *X = slope + 3 * n * w, *d = X + 3 * c * w;
  double *energy = d + w, *least = energy + w;
  for (std::size_t l = 0; l < w; ++l) {
    d[l] = delta;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      for (std::size_t m = 0; m < n; ++m) x[(i * n + m) * w + l] = element.nodes[m][k];
      for (std::size_t m = 0; m < c; ++m) {
        const auto place = static_cast<std::size_t>(lattice_map(plan.shape(), 1).corner[m]);
        X[(i * c + place) * w + l] = element.corner[m][k];
      }
    }
  }
  detail::energy_kernel_of(lanes).run(kind, plan.view(), x, X, d, slope, energy, least);
  KernelResult result{energy[w - 1], least[w - 1], Points(n)};
  for (std::size_t m = 0; m < n; ++m) {
    result.slope[m] =
        Vec3(slope[m * w + w - 1], slope[(n + m) * w + w - 1], slope[(2 * n + m) * w + w - 1]);
  }
  return result;
}

struct Setting {
  EnergyKind kind;
  double delta, amplitude;
};
constexpr Setting k_settings[] = {{EnergyKind::shape, 0.0, 0.05},
                                  {EnergyKind::shape, 0.3, 0.6},
                                  {EnergyKind::quality, 0.0, 0.05},
                                  {EnergyKind::metric, 0.0, 0.6}};

TEST(EnergyKernel, AgreesWithTheFormulasAndWithDualNumbersForEveryShapeAndOrder) {
  std::mt19937 random(1);
  for (const Setting& setting : k_settings) {
    for (const Shape shape : k_volumes) {
      for (int order = 1; order <= 4; ++order) {
        const EnergyPlan& plan = detail::energy_plan(shape, order);
        const Element element(shape, order, setting.amplitude, random);
        const KernelResult result =
            run_kernel(setting.kind, plan, element, setting.delta, widest_lanes());

        const double energy =
            naive_energy<double>(setting.kind, plan, element.nodes, element.corner, setting.delta);
        ASSERT_TRUE(std::isfinite(energy));
        EXPECT_NEAR(result.energy, energy, 1e-11 * energy);
        double largest = 0.0;
        for (const Vec3& g : result.slope) largest = std::max(largest, g.norm());
        for (int trial = 0; trial < 3; ++trial) {
          const std::size_t n = random() % element.nodes.size();
          std::vector<Vec<Dual<3>, 3>> nodes(element.nodes.size());
          for (std::size_t m = 0; m < nodes.size(); ++m) {
            for (int i = 0; i < 3; ++i) {
              nodes[m](i) =
                  m == n ? Dual<3>::variable(element.nodes[m][i], i) : Dual<3>(element.nodes[m][i]);
            }
          }
          const Dual<3> dual =
              naive_energy<Dual<3>>(setting.kind, plan, nodes, element.corner, setting.delta);
          for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(result.slope[n][i], dual.d[static_cast<std::size_t>(i)], 1e-10 * largest)
                << name(shape) << " " << order;
          }
        }
      }
    }
  }
}

TEST(EnergyKernel, GivesTheSameBitsForAnyNumberOfLanes) {
  std::mt19937 random(2);
  for (const Setting& setting : k_settings) {
    const EnergyPlan& plan = detail::energy_plan(Shape::prism, 3);
    const Element element(Shape::prism, 3, setting.amplitude, random);
    const KernelResult alone = run_kernel(setting.kind, plan, element, setting.delta, 1);
    for (int lanes : {2, 4, 8}) {
      if (!has_lanes(lanes)) continue;
      const KernelResult several = run_kernel(setting.kind, plan, element, setting.delta, lanes);
      EXPECT_EQ(several.energy, alone.energy) << lanes;
      EXPECT_EQ(several.least, alone.least) << lanes;
      EXPECT_EQ(several.slope, alone.slope) << lanes;
    }
  }
}

TEST(EnergyKernel, IsInfiniteInQualityAndFiniteInRegularisedShapeWhereInverted) {
  std::mt19937 random(3);
  const EnergyPlan& plan = detail::energy_plan(Shape::hexahedron, 2);
  Element element(Shape::hexahedron, 2, 0.0, random);
  element.nodes[static_cast<std::size_t>(lattice_map(Shape::hexahedron, 2).edge_interior[0][0])] +=
      Vec3(0.9, 0.0, 0.0);
  const KernelResult quality = run_kernel(EnergyKind::quality, plan, element, 0.0, 1);
  EXPECT_LT(quality.least, 0.0);
  EXPECT_TRUE(std::isinf(quality.energy));
  EXPECT_TRUE(std::isfinite(run_kernel(EnergyKind::shape, plan, element, 0.1, 1).energy));
}

/// A cube of all shapes, orders 1 to 4 at random, nodes shaken.
struct Cube {
  LinearMesh mesh;
  Topology topology;
  CurvedMesh curved;
  std::vector<Index> cells;

  explicit Cube(unsigned seed, double amplitude, bool is_mixed = true)
      : mesh(build_linear_mesh(cube_mesh(testing::Filling::hybrid, 2, seed))),
        topology(build_topology(mesh)),
        curved(mesh, topology, orders(seed, is_mixed)) {
    std::mt19937 random(seed);
    shake(curved, amplitude, random);
    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      if (curved.cell_order(c) > 1) cells.push_back(c);
    }
  }
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;

  [[nodiscard]] OrderField orders(unsigned seed, bool is_mixed) const {
    std::mt19937 random(seed);
    if (is_mixed) return minimum_rule(topology, random_orders(mesh.cell_count(), 4, random));
    return minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(), std::uint8_t{3}));
  }
  [[nodiscard]] CellEnergy energy() const { return {curved, cells, free_nodes(curved)}; }
};

TEST(CellEnergy, IsTheSumOverCellsOfMixedOrder) {
  const Cube cube(4, 0.01);
  CellEnergy energy = cube.energy();
  double expected = 0.0;
  Points nodes;
  for (Index c : cube.cells) {
    const Shape shape = cube.mesh.cell_shape[at(c)];
    cube.curved.gather(c, cube.curved.cell_order(c), nodes);
    std::vector<Vec3> corner;
    for (Index v : cube.mesh.cell(c)) corner.push_back(cube.mesh.vertices[at(v)]);
    expected += naive_energy<double>(EnergyKind::quality,
                                     detail::energy_plan(shape, cube.curved.cell_order(c)), nodes,
                                     corner, 0.0);
  }
  VecX gradient;
  EXPECT_NEAR(energy.evaluate(EnergyKind::quality, energy.positions(cube.curved), 0.0, gradient),
              expected, 1e-11 * expected);
}

TEST(CellEnergy, HasTheSlopeOfItsDifferences) {
  const Cube cube(5, 0.01);
  CellEnergy energy = cube.energy();
  energy.add_sample(0, reference_centroid(cube.mesh.cell_shape[at(cube.cells[0])]));
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (const EnergyKind kind : {EnergyKind::shape, EnergyKind::quality}) {
    const VecX x = energy.positions(cube.curved);
    VecX gradient, unused;
    energy.evaluate(kind, x, 0.0, gradient);
    for (int trial = 0; trial < 3; ++trial) {
      VecX d(x.size());
      for (double& v : d) v = normal(random);
      const double h = 1e-7;
      const double difference = (energy.evaluate(kind, x + h * d, 0.0, unused) -
                                 energy.evaluate(kind, x - h * d, 0.0, unused)) /
                                (2.0 * h);
      EXPECT_NEAR(gradient.dot(d), difference, 1e-5 * gradient.norm() * d.norm());
    }
  }
}

TEST(CellEnergy, HasTheSameBitsForAnyNumberOfThreads) {
  const Cube cube(7, 0.01);
  std::vector<VecX> seen;
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    CellEnergy energy = cube.energy();
    VecX gradient;
    energy.evaluate(EnergyKind::shape, energy.positions(cube.curved), 0.1, gradient);
    seen.push_back(gradient);
  }
  EXPECT_EQ(seen[1], seen[0]);
  EXPECT_EQ(seen[2], seen[0]);
}

/// K as one dense matrix.
MatX stiffness(CellEnergy& energy) {
  std::vector<Index> all(energy.unknowns().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  return energy.diagonal_blocks({all}).front();
}

TEST(CellEnergy, AppliesTheStiffnessThatItsBlocksAreOf) {
  const Cube cube(8, 0.0);
  CellEnergy energy = cube.energy();
  const MatX K = stiffness(energy);
  EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatX>(K).eigenvalues().minCoeff(), 0.0);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  VecX v(energy.size()), Kv;
  for (double& x : v) x = normal(random);
  energy.apply_stiffness(v, Kv);
  for (Eigen::Index i = 0; i < 3; ++i) {
    VecX own(K.rows()), expected;
    for (Eigen::Index k = 0; k < K.rows(); ++k) own[k] = v[3 * k + i];
    expected = K * own;
    for (Eigen::Index k = 0; k < K.rows(); ++k) EXPECT_NEAR(Kv[3 * k + i], expected[k], 1e-10);
  }
}

TEST(GroupSolver, InvertsExactlyWhereAllIsOneGroup) {
  const Cube cube(10, 0.0);
  CellEnergy energy = cube.energy();
  std::vector<Index> all(energy.unknowns().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
  const detail::GroupSolver solver({all}, energy.diagonal_blocks({all}));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  VecX v(energy.size()), Kv, back;
  for (double& x : v) x = normal(random);
  energy.apply_stiffness(v, Kv);
  solver.solve(Kv, back);
  EXPECT_LT((back - v).norm(), 1e-9 * v.norm());
}

TEST(Elastic, SolvesTheStiffnessEquationWhateverTheStartWas) {
  Cube cube(12, 0.02);
  ElasticOptions options;
  options.tolerance = 1e-11;
  CurvedMesh other = cube.curved;
  const std::vector<std::uint8_t> is_free = free_nodes(other);
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    if (is_free[i]) other.high_order_nodes()[i] += Vec3(0.3, -0.2, 0.1);
  }
  relax_elastic(cube.curved, cube.cells, is_free, options);
  relax_elastic(other, cube.cells, is_free, options);
  for (std::size_t i = 0; i < is_free.size(); ++i) {
    EXPECT_LT((cube.curved.high_order_nodes()[i] - other.high_order_nodes()[i]).norm(), 1e-13);
  }
  // At the minimum the metric energy has no slope, straight copy subtracted.
  const CurvedMesh straight(cube.mesh, cube.topology, cube.curved.orders());
  CellEnergy energy(cube.curved, cube.cells, is_free);
  VecX Ku;
  energy.apply_stiffness(energy.positions(cube.curved) - energy.positions(straight), Ku);
  const VecX load = energy.load(cube.curved, straight);
  EXPECT_LT((Ku - load).norm(), 1e-9 * load.norm());
}

TEST(Elastic, LeavesAStraightMeshStraight) {
  Cube cube(13, 0.0);
  const Points before(cube.curved.high_order_nodes().begin(), cube.curved.high_order_nodes().end());
  const ElasticResult result = relax_elastic(cube.curved, cube.cells, free_nodes(cube.curved));
  EXPECT_EQ(result.products, 0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((cube.curved.high_order_nodes()[i] - before[i]).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace camber
