/// What `check` says of beams that cannot be.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

using tests::mistake_in;
using tests::text_of_file;

/// A beam of its own, without a gas.
const std::string alone = R"(time: {end: 1, dt: 0.1}
solids:
  bar:
    law: beam
    rho: 1
    E: 3
    nu: 0.3
    beam: {line: [[0, 0], [1, 0]], thickness: 0.1, elements: 10, ends: [clamped, free]}
    grid: {x: [0, 1], y: [-0.05, 0.05], points: [11, 5]}
    boundary: {left: free, right: free, bottom: free, top: free}
)";

TEST(Beams, MistakesSayWhereAndWhatToWrite) {
  struct Mistake {
    std::string text, setting, says;
  };
  const std::string panel = text_of_file(FSI_ROOT "/configs/shocked_panel.yaml"),
                    plate = text_of_file(FSI_ROOT "/configs/taylor_plate.yaml");
  EXPECT_EQ(mistake_in(alone), "");
  for (const auto& [text, setting, says] : std::vector<Mistake>{
           {panel, "solids.panel.beam.ends=[free, free]",
            "the outline ends at (0.5, 0) on a wall, and the first end of the line there is free: the "
            "section would "
            "move and leave the wall, and the grid of the gas with it; write clamped, or guided"},
           {panel, "solids.panel.beam.ends=[pinned, free]",
            "there is pinned: the section would turn and leave"},
           {panel, "solids.panel.beam.ends=[guided, free]", ""},
           {panel, "solids.panel.beam.line=[[0, 50], [0, 0]]", "the last end of the line there is free"},
           {panel, "solids.panel.beam.thickness=y - 1",
            "is -0.6094 at (0, 0.3906); let it be positive along the line"},
           {panel, "solids.panel.beam.line=[[100, 0], [100, 50]]",
            "(100, 0) is not in the body, which lies in (-0.5"},
           {plate, "solids.plate.beam.line=[[1, 0], [1, 0.1]]",
            "is not in the body, which lies in (0, 0) .. (0.05, 0.1)"},
           {plate, "parameters.mass=0", ""},
           {plate, "parameters.mass=0,solids.plate.beam.ends=[free, free]",
            "hold one of its ends, or give it a mass"},
           {plate, "fluids.left.p_e=2", "write the same in both (either may begin at another pressure)"},
           {alone.substr(0, alone.find(", dt")) + alone.substr(alone.find('}')), "",
            "a beam without a gas has no largest step of its own; write `dt` [time]"}}) {
    std::vector<std::string> settings;
    const std::size_t second = setting.find(",solids");
    if (!setting.empty()) settings.push_back(setting.substr(0, second));
    if (second != std::string::npos) settings.push_back(setting.substr(second + 1));
    const std::string message = mistake_in(text, settings);
    EXPECT_NE(message.find(says), std::string::npos) << message << "\nexpected: " << says;
    EXPECT_EQ(message.empty(), says.empty()) << message;
  }
}

}  // namespace
}  // namespace fsi
