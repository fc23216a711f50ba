// Carried start on thin layers: nothing may be inverted, whatever the height of the first cell.
#include <camber/elevate/rescue.hpp>

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace camber {
namespace {

using namespace testing;

/// The others need rescue: two faces round 180 degrees, and caps that meet in the narrow tips of an
/// ellipsoid's inside.
bool is_valid_as_carried(const BodyCase& body) {
  return body.body != "tip" && !(body.body == "ellipsoid-inside" && body.filling == "caps");
}

class Ladder : public ::testing::TestWithParam<double> {};

TEST_P(Ladder, LeavesNothingInvalidAtOrderFour) {
  for (const BodyCase& body : body_cases(CaseSize::small)) {
    if (!is_valid_as_carried(body)) continue;
    const auto c = make_case(body.mesh(GetParam()), body.model());
    const LayerField field = c->field();
    const CurvedMesh curved = carried(*c, field, 4);

    const std::vector<Index> bad = uncertified_cells(curved, all_cells(c->mesh));

    EXPECT_TRUE(bad.empty()) << body.body << ", " << body.filling << ": " << bad.size() << " of "
                             << c->mesh.cell_count();
  }
}

INSTANTIATE_TEST_SUITE_P(FirstCell, Ladder, ::testing::Values(1e-2, 1e-4, 1e-6));

}  // namespace
}  // namespace camber
