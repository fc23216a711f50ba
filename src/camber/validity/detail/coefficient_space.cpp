#include <camber/validity/detail/coefficient_space.hpp>

#include <algorithm>
#include <cstddef>

namespace camber::detail {

namespace {

// The multi-index of every factor for one coefficient number.
std::vector<MultiIndex> split_index(const CoefficientSpace& space,
                                    const std::vector<std::vector<MultiIndex>>& tables, int index) {
  std::vector<MultiIndex> parts;
  for (std::size_t f = 0; f < space.factors.size(); ++f) {
    const int size = space.factors[f].size();
    parts.push_back(tables[f][static_cast<std::size_t>(index % size)]);
    index /= size;
  }
  return parts;
}

std::vector<std::vector<MultiIndex>> factor_tables(const CoefficientSpace& space) {
  std::vector<std::vector<MultiIndex>> tables;
  for (const Factor& f : space.factors) tables.push_back(multi_indices(f));
  return tables;
}

}  // namespace

int Factor::size() const { return static_cast<int>(binomial(degree + dim, dim) + 0.5); }

int CoefficientSpace::size() const {
  int n = 1;
  for (const Factor& f : factors) n *= f.size();
  return n;
}

int CoefficientSpace::stride(int factor) const {
  int n = 1;
  for (int f = 0; f < factor; ++f) n *= factors[static_cast<std::size_t>(f)].size();
  return n;
}

double binomial(int n, int k) {
  if (k < 0 || k > n) return 0.0;
  double c = 1.0;
  for (int i = 1; i <= std::min(k, n - k); ++i) c = c * (n - i + 1) / i;  // stays an integer
  return c;
}

std::vector<MultiIndex> multi_indices(const Factor& factor) {
  const int n = factor.degree;
  std::vector<MultiIndex> all;
  for (int k = 0; k <= (factor.dim >= 3 ? n : 0); ++k) {
    for (int j = 0; j <= (factor.dim >= 2 ? n - k : 0); ++j) {
      for (int i = 0; i <= n - j - k; ++i) all.push_back({n - i - j - k, i, j, k});
    }
  }
  return all;
}

int multi_index_place(const Factor& factor, const MultiIndex& index) {
  int place = index[1];
  for (int j = 0; j < index[2]; ++j) place += factor.degree - index[3] - j + 1;
  for (int k = 0; k < index[3]; ++k) place += Factor{2, factor.degree - k}.size();
  return place;
}

double multinomial(const Factor& factor, const MultiIndex& index) {
  int rest = factor.degree;
  double m = 1.0;
  for (int i : index) {
    m *= binomial(rest, i);
    rest -= i;
  }
  return m;
}

std::vector<double> multinomials(const CoefficientSpace& space) {
  std::vector<double> all{1.0};
  for (const Factor& f : space.factors) {
    std::vector<double> next;
    for (const MultiIndex& index : multi_indices(f)) {
      for (double faster : all) next.push_back(faster * multinomial(f, index));
    }
    all = std::move(next);
  }
  return all;
}

CoefficientSpace product_space(const CoefficientSpace& a, const CoefficientSpace& b) {
  CoefficientSpace c = a;
  for (std::size_t f = 0; f < c.factors.size(); ++f) c.factors[f].degree += b.factors[f].degree;
  return c;
}

MatX factor_elevation(const Factor& from, const Factor& to) {
  const Factor gap{from.dim, to.degree - from.degree};
  MatX E = MatX::Zero(to.size(), from.size());
  const std::vector<MultiIndex> from_indices = multi_indices(from);
  for (const MultiIndex& b : multi_indices(to)) {
    for (const MultiIndex& a : from_indices) {
      MultiIndex d{};
      bool inside = true;
      for (std::size_t i = 0; i < d.size(); ++i) {
        d[i] = b[i] - a[i];
        inside = inside && d[i] >= 0;
      }
      if (!inside) continue;
      E(multi_index_place(to, b), multi_index_place(from, a)) =
          multinomial(from, a) * multinomial(gap, d) / multinomial(to, b);
    }
  }
  return E;
}

std::vector<CornerCoefficient> corner_coefficients(const CoefficientSpace& space) {
  std::vector<CornerCoefficient> all(1);
  for (std::size_t f = 0; f < space.factors.size(); ++f) {
    const Factor& factor = space.factors[f];
    const int stride = space.stride(static_cast<int>(f));
    const int corners = factor.degree == 0 ? 1 : factor.dim + 1;
    std::vector<CornerCoefficient> next;
    for (int corner = 0; corner < corners; ++corner) {
      MultiIndex index{};
      index[static_cast<std::size_t>(corner)] = factor.degree;
      for (CornerCoefficient c : all) {
        c.coefficient += stride * multi_index_place(factor, index);
        c.vertex[f] = corner;
        next.push_back(c);
      }
    }
    all = std::move(next);
  }
  return all;
}

std::vector<CoefficientRow> coefficient_rows(const CoefficientSpace& space) {
  std::vector<CoefficientRow> rows;
  const Factor& first = space.factors.front();
  const int first_size = first.size();
  const std::vector<MultiIndex> indices = multi_indices(first);
  for (int block = 0; block < space.size() / first_size; ++block) {
    for (int n = 0; n < first_size; ++n) {
      const MultiIndex& index = indices[static_cast<std::size_t>(n)];
      if (index[1] == 0) rows.push_back({block * first_size + n, index[0] + 1});
    }
  }
  return rows;
}

std::vector<std::int32_t> product_rows(const CoefficientSpace& a, const CoefficientSpace& b) {
  const CoefficientSpace c = product_space(a, b);
  const auto tables_a = factor_tables(a);
  const auto tables_b = factor_tables(b);
  std::vector<std::int32_t> out;
  for (const CoefficientRow& row_a : coefficient_rows(a)) {
    const std::vector<MultiIndex> index_a = split_index(a, tables_a, row_a.start);
    for (const CoefficientRow& row_b : coefficient_rows(b)) {
      const std::vector<MultiIndex> index_b = split_index(b, tables_b, row_b.start);
      int place = 0;
      for (std::size_t f = 0; f < c.factors.size(); ++f) {
        MultiIndex sum{};
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = index_a[f][i] + index_b[f][i];
        place += c.stride(static_cast<int>(f)) * multi_index_place(c.factors[f], sum);
      }
      out.push_back(place);
    }
  }
  return out;
}

}  // namespace camber::detail
