#include <camber/basis/bernstein.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/validity/detail/determinant_plan.hpp>

namespace camber::detail {

namespace {

Shape simplex(int dim) {
  return dim == 1 ? Shape::line : dim == 2 ? Shape::triangle : Shape::tetrahedron;
}

// Plain Bernstein coefficients (degree n) from nodal values, one factor.
MatX conversion(const Factor& factor) {
  return factor.degree == 0 ? MatX::Ones(1, 1)
                            : bernstein_from_lattice(simplex(factor.dim), factor.degree);
}

// K such that K * (differences v[m + e_d] - v[m], m over the lattice of degree n - 1) are the
// Bernstein coefficients of the derivative along e_d. The differences decide the derivative,
// because both vanish for exactly the polynomials that do not depend on xi_d; so a cell that is
// thin along xi_d loses no digits to its width.
MatX derivative(const Factor& factor, int d) {
  const Factor lower{factor.dim, factor.degree - 1};
  const MatX M = conversion(factor);
  const std::vector<MultiIndex> indices = multi_indices(lower);
  const auto along = static_cast<std::size_t>(d + 1);
  MatX K(lower.size(), lower.size());
  for (int r = 0; r < lower.size(); ++r) {
    MultiIndex a = indices[static_cast<std::size_t>(r)], b = a;
    ++a[0];
    ++b[along];
    const VecX weight =
        static_cast<double>(factor.degree) *
        (M.row(multi_index_place(factor, b)) - M.row(multi_index_place(factor, a))).transpose();
    for (int c = 0; c < lower.size(); ++c) {
      // Node m + t e_d holds the sum of the differences before it on its line.
      MultiIndex node = indices[static_cast<std::size_t>(c)];
      double sum = 0.0;
      for (int left = node[0] + 1; left > 0; --left) {
        ++node[along];
        node[0] = left - 1;
        sum += weight(multi_index_place(factor, node));
      }
      K(r, c) = sum;
    }
  }
  return K;
}

// The shape as a product: dimensions of its factors.
std::vector<int> factor_dims(Shape shape) {
  switch (shape) {
    case Shape::triangle:
      return {2};
    case Shape::quadrilateral:
      return {1, 1};
    case Shape::tetrahedron:
      return {3};
    case Shape::prism:
      return {2, 1};
    default:
      return {1, 1, 1};
  }
}

}  // namespace

std::vector<ColumnTable> tensor_columns(Shape shape, int p) {
  const std::vector<int> dims = factor_dims(shape);
  std::vector<ColumnTable> columns;
  int axis = 0;
  for (std::size_t f = 0; f < dims.size(); ++f) {
    for (int d = 0; d < dims[f]; ++d, ++axis) {
      ColumnTable column;
      for (std::size_t g = 0; g < dims.size(); ++g) {
        column.space.factors.push_back({dims[g], g == f ? p - 1 : p});
      }
      // Differences on the lattice with one step less along this factor, in the order of the space.
      std::vector<std::vector<MultiIndex>> tables;
      for (const Factor& factor : column.space.factors) tables.push_back(multi_indices(factor));
      for (int n = 0; n < column.space.size(); ++n) {
        LatticePoint point{};
        int rest = n, first_axis = 0;
        for (std::size_t g = 0; g < dims.size(); ++g) {
          const int size = column.space.factors[g].size();
          const MultiIndex& index = tables[g][static_cast<std::size_t>(rest % size)];
          rest /= size;
          for (int i = 0; i < dims[g]; ++i) {
            point[static_cast<std::size_t>(first_axis + i)] =
                index[static_cast<std::size_t>(i + 1)];
          }
          first_axis += dims[g];
        }
        column.from.push_back(lattice_index(shape, p, point));
        ++point[static_cast<std::size_t>(axis)];
        column.to.push_back(lattice_index(shape, p, point));
      }
      for (std::size_t g = 0; g < dims.size(); ++g) {
        const int factor = static_cast<int>(g);
        FactorPass pass;
        pass.matrix = g == f ? derivative({dims[g], p}, d) : conversion({dims[g], p});
        pass.inner = column.space.stride(factor);
        pass.outer = column.space.size() / (pass.inner * column.space.factors[g].size());
        column.passes.push_back(std::move(pass));
      }
      columns.push_back(std::move(column));
    }
  }
  return columns;
}

}  // namespace camber::detail
