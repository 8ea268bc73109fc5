// SPDX-License-Identifier: MIT
// What panels and dialogs offer where the model is no surface.
#include "geotherm/domains.h"
#include "tests/ui/driver.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class PanelsOfSpaces : public UiTest {
 protected:
  void SetUp() override {
    open_square();
    const std::vector<double> speeds(5 * 5 * 5, 1);
    Grid block;
    block.size = {5, 5, 5};
    ASSERT_TRUE(write_distances((folder() / "block.vti").string(), block, speeds));
  }
};

TEST_F(PanelsOfSpaces, OfferTheBoundaryOfAClosedBody) {
  run("open " + (folder() / "block.vti").string());
  frames(2);
  ASSERT_EQ(session_.explored().model->mesh->boundary_edges, 0) << "its outside is closed";
  EXPECT_FALSE(session_.explored().model->figures.empty());
  click_item("Sources/boundary");
  EXPECT_EQ(sent(), Texts{"source set boundary"});
}

TEST_F(PanelsOfSpaces, OfferFilesOfGridsAndTheirDistances) {
  click_item("Model/open");
  fill("Files/folder", folder().string());
  EXPECT_TRUE(is_drawn("Files/block.vti"));
  EXPECT_TRUE(is_drawn("Files/square.obj"));
}

}  // namespace
}  // namespace geotherm::ui
