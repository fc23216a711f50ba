#include <camber/geom/primitive.hpp>
#include <camber/pipeline/family_link.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

MeshData with_patches(const std::vector<std::string>& names) {
  MeshData mesh;
  for (const std::string& name : names) {
    EntityRecord& entity = mesh.entities.emplace_back();
    entity.key = {2, static_cast<int>(mesh.entities.size())};
    entity.name = name;
  }
  return mesh;
}

TEST(FamilyLink, GivesTheRulesOfPatchesWhoseFacesTheCadHas) {
  const auto sphere = make_primitive("sphere:0,0,0,1");  // face_1 alone
  const MeshData mesh = with_patches({"skin", "far", "kept", "other", "lost"});
  TagOptions rules;
  rules.patches["kept"] = PatchRule::fixed;

  const FamilyLink link = link_by_families({{"skin", "a", "C:\\cad\\body.step", {"face_1"}},
                                            {"kept", "a", "", {"face_1"}},
                                            {"elsewhere", "a", "", {"face_1"}},
                                            {"other", "b", "wing.step", {"face_1"}},
                                            {"lost", "c", "", {"face_1", "face_9"}}},
                                           mesh, *sphere, "/home/me/body.step", rules);

  EXPECT_EQ(link.patches, 1U);
  EXPECT_EQ(rules.faces.size(), 1U);
  EXPECT_THAT(rules.faces["skin"], ElementsAre("face_1"));
  ASSERT_EQ(link.left_out.size(), 2U);
  EXPECT_THAT(link.left_out[0], HasSubstr("other: 'face_1' is a face of 'wing.step'"));
  EXPECT_THAT(link.left_out[1], HasSubstr("lost: the CAD has no face 'face_9'"));
}

}  // namespace
}  // namespace camber
