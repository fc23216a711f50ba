#include <camber/base/parallel.hpp>
#include <camber/validity/batch.hpp>

#include <cstring>
#include <stdexcept>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

struct Sample {
  std::vector<ElementKind> kinds;
  std::vector<Points> nodes;
};

// A hybrid mixed-order pile, from good to inverted.
Sample pile(int elements) {
  std::mt19937 generator(61);
  Sample sample;
  for (int i = 0; i < elements; ++i) {
    const Shape shape = testing::volume_shapes()[static_cast<std::size_t>(i * 7 % 4)];
    const int p = 1 + i * 5 % 3;
    sample.kinds.push_back({shape, p});
    sample.nodes.push_back(
        testing::random_element(shape, p, (i % 11 == 0 ? 0.4 : 0.05) / p, generator));
  }
  return sample;
}

GatherNodes gather(const Sample& sample) {
  return [&sample](std::size_t i, Points& nodes) {
    nodes = sample.nodes[i];
    return sample.kinds[i];
  };
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same(const JacobianBounds& a, const JacobianBounds& b) {
  return a.verdict == b.verdict && same_bits(a.min_lower, b.min_lower) &&
         same_bits(a.min_upper, b.min_upper) && same_bits(a.max_upper, b.max_upper) &&
         same_bits(a.scaled_jacobian, b.scaled_jacobian) &&
         same_bits(a.jacobian_ratio, b.jacobian_ratio) && a.worst_xi == b.worst_xi;
}

TEST(Batch, GivesTheBitsOfTheSingleCallForAnyNumberOfThreads) {
  const Sample sample = pile(700);

  for (int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const std::vector<JacobianBounds> all = certify_all(700, gather(sample));
    const std::vector<Verdict> verdicts = quick_verdicts(700, gather(sample));

    ASSERT_EQ(all.size(), 700u);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto [shape, p] = sample.kinds[i];
      EXPECT_TRUE(same(all[i], certify(shape, p, sample.nodes[i]))) << i;
      EXPECT_EQ(verdicts[i], quick_verdict(shape, p, sample.nodes[i])) << i;
    }
  }
}

TEST(Batch, OfNothingIsEmpty) {
  const Sample sample;

  EXPECT_TRUE(certify_all(0, gather(sample)).empty());
  EXPECT_TRUE(quick_verdicts(0, gather(sample)).empty());
}

TEST(Batch, RethrowsWhatTheGatherThrows) {
  const GatherNodes broken = [](std::size_t i, Points&) -> ElementKind {
    if (i == 3) throw std::out_of_range("three");
    throw std::runtime_error("other");
  };
  const GatherNodes short_of_nodes = [](std::size_t, Points& nodes) {
    nodes.assign(3, Vec3::Zero());
    return ElementKind{Shape::hexahedron, 1};
  };

  EXPECT_THROW((void)certify_all(10, broken), std::runtime_error);
  EXPECT_THROW((void)certify_all(1, short_of_nodes), std::invalid_argument);
}

}  // namespace
}  // namespace camber
