/// What `check` says of beams that cannot be.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/case/report/remarks.hpp"
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

struct BeamMistake {
  std::string text, setting, says;  ///< of the message; empty: there is none
};

void expect_messages(const std::vector<BeamMistake>& mistakes) {
  for (const auto& [text, setting, says] : mistakes) {
    std::vector<std::string> settings;
    const std::size_t second = setting.find(",solids");
    if (!setting.empty()) settings.push_back(setting.substr(0, second));
    if (second != std::string::npos) settings.push_back(setting.substr(second + 1));
    const std::string message = mistake_in(text, settings);
    EXPECT_NE(message.find(says), std::string::npos) << message << "\nexpected: " << says;
    EXPECT_EQ(message.empty(), says.empty()) << message;
  }
}

TEST(Beams, MistakesInABodyOnAWallSayWhereAndWhatToWrite) {
  const std::string panel = text_of_file(FSI_ROOT "/configs/shocked_panel.yaml");
  expect_messages(
      {{panel, "solids.panel.beam.ends=[free, free]",
        "the outline ends at (0.5, 0) on a wall, and the first end of the line there is free: the "
        "section would "
        "move and leave the wall, and the grid of the gas with it; write clamped, or guided"},
       {panel, "solids.panel.beam.ends=[pinned, free]", "there is pinned: the section would turn and leave"},
       {panel, "solids.panel.beam.ends=[guided, free]", ""},
       {panel, "solids.panel.beam.line=[[0, 50], [0, 0]]", "the last end of the line there is free"},
       {panel, "solids.panel.beam.thickness=y - 1",
        "is -0.6094 at (0, 0.390625); let it be positive along the line"},
       {panel, "solids.panel.beam.line=[[100, 0], [100, 50]]",
        "(100, 0) is not in the body, which lies in (-0.5"},
       {panel, "solids.panel.beam.line=[[0, 10], [0, 50]]",
        "solids.panel.beam.line: its first end (0, 10) is 10 away from the foot of the outline, more "
        "than "
        "the thickness, 1; let that end be (0, 0), in the middle of the foot"},
       {panel, "solids.panel.beam.line=[[0, 0.5], [0, 50]]", ""}});
}

TEST(Beams, MistakesInABodyBetweenWallsSayWhereAndWhatToWrite) {
  const std::string plate = text_of_file(FSI_ROOT "/configs/taylor_plate.yaml"),
                    panel_in_stream = text_of_file(FSI_ROOT "/configs/panel_flutter.yaml"),
                    bar = text_of_file(FSI_ROOT "/configs/clamped_bar.yaml");
  expect_messages(
      {{plate, "solids.plate.beam.line=[[1, 0], [1, 0.1]]",
        "is not in the body, which lies in (0, 0) .. (0.05, 0.1)"},
       {plate, "solids.plate.boundary.top=free", ""},  // guided: it stays on the wall
       {plate, "solids.plate.beam.ends=[free, free]", ""},
       {plate, "solids.plate.beam.ends=[pinned, free]", ""},
       {plate, "solids.plate.boundary.top=free,solids.plate.beam.ends=[guided, free]",
        "solids.plate.boundary.top: the last end of the beam is free and stands at (0, 0.1) on the top "
        "side of "
        "fluids.left.grid, a wall: its section would move and leave the wall, and the grid of the gas "
        "with it; "
        "write `top: slip_wall` (it slides along the wall), or let that end be clamped or guided"},
       {plate, "solids.plate.boundary.top=clamped,solids.plate.beam.ends=[guided, pinned]",
        "the last end of the beam is pinned and stands at (0, 0.1) on the top side of fluids.left.grid, "
        "a wall: "
        "its section would turn and leave the wall"},
       {panel_in_stream, "", ""},  // its ends are at an inflow and an outflow
       {panel_in_stream, "fluid.boundary.left=symmetry,solids.panel.beam.ends=[pinned, pinned]",
        "the first end of the beam is pinned and stands at (0, 0) on the left side of fluid.grid, a "
        "wall"},
       {bar, "solids.bar.boundary.top=free,solids.bar.beam.ends=[free, clamped]",
        "the first end of the beam is free and stands at (0, 0.1) on the top side of fluid.grid, a wall"},
       {plate, "parameters.mass=0", ""},
       {plate, "parameters.mass=0,solids.plate.beam.ends=[free, free]",
        "hold one of its ends, or give it a mass"},
       {plate, "fluids.left.p_e=2", "write the same in both (either may begin at another pressure)"}});
}

TEST(Beams, WithoutAGasNeedAStep) {
  EXPECT_EQ(mistake_in(alone), "");
  expect_messages({{alone.substr(0, alone.find(", dt")) + alone.substr(alone.find('}')), "",
                    "a beam without a gas has no largest step of its own; write `dt` [time]"}});
}

TEST(Beams, WithoutAGasAndWithoutMassAreHeldByTheirEnds) {
  const auto of_ends = [](const char* ends) {
    std::vector<std::string> settings{fmt::format("solids.bar.beam.ends={}", ends)};
    settings.emplace_back("solids.bar.rho=0");
    return settings;
  };
  for (const char* ends : {"[clamped, free]", "[pinned, pinned]", "[guided, pinned]"})
    EXPECT_EQ(mistake_in(alone, of_ends(ends)), "") << ends;
  EXPECT_NE(mistake_in(alone, of_ends("[pinned, free]")).find("nothing would resist that this beam turns"),
            std::string::npos);
  for (const char* ends : {"[guided, free]", "[guided, guided]"})
    EXPECT_NE(
        mistake_in(alone, of_ends(ends)).find("nothing would resist that this beam moves across its line"),
        std::string::npos)
        << ends;
}

TEST(Beams, OfNoMassMayHaveGuidedEndsThatAreNotParallel) {
  EXPECT_EQ(mistake_in(alone, {"solids.bar.rho=0", "solids.bar.beam.ends=[guided, guided]",
                               "solids.bar.beam.line=[[0, 0], [0.6, 0.1], [0.9, 0.4], [1, 1]]",
                               "solids.bar.grid.y=[0, 1]"}),
            "");
}

TEST(Beams, AreNotClampedByTheSideOfTheirGrid) {
  const auto said = [](const char* ends, const char* side) {
    return mistake_in(alone, {fmt::format("solids.bar.beam.ends={}", ends),
                              fmt::format("solids.bar.boundary.{}=clamped", side)});
  };
  EXPECT_EQ(said("[clamped, free]", "left"), "");
  EXPECT_EQ(said("[pinned, pinned]", "right"), "");
  EXPECT_NE(said("[clamped, free]", "right")
                .find("solids.bar.boundary.right: clamps nothing: the last end of the beam there is free; "
                      "write `beam: "
                      "{ends: [.., clamped]}`"),
            std::string::npos);
  EXPECT_NE(
      said("[clamped, clamped]", "top").find("clamps nothing: no end of the beam's line is at this side"),
      std::string::npos);
  const std::vector<std::string> arch{"solids.bar.beam.line=[[0, 0], [0.3, 0.5], [0.7, 0.5], [1, 0]]",
                                      "solids.bar.grid.y=[0, 1]", "solids.bar.beam.ends=[clamped, pinned]",
                                      "solids.bar.boundary.bottom=clamped"};
  EXPECT_EQ(mistake_in(alone, arch), "");
}

// What is beyond the end of the gas keeps the end of a beam that is there; at any other side it would do nothing.
TEST(Beams, AreKeptByAWallOnlyWhereAGasEndsAtIt) {
  const std::string plate = text_of_file(FSI_ROOT "/configs/plate.yaml"),
                    bar = text_of_file(FSI_ROOT "/configs/clamped_bar.yaml");
  const char* const says =
      "holds nothing of a beam: no gas ends at this side; write free, and what holds the "
      "beam as `beam: {ends: [.., ..]}`";
  expect_messages({{plate, "solids.plate.boundary.top=symmetry", ""},
                   {plate, "solids.plate.boundary.left=slip_wall", says},
                   {bar, "", ""},
                   {bar, "solids.bar.boundary.right=slip_wall,solids.bar.beam.ends=[free, free]", says},
                   {bar, "solids.bar.boundary.right=symmetry", says},
                   {alone, "solids.bar.boundary.left=slip_wall", says},
                   {alone, "solids.bar.boundary.bottom=symmetry", says}});
  EXPECT_NE(mistake_in(alone, {"solids.bar.boundary.left=slip_wall"}).find("solids.bar.boundary.left: "),
            std::string::npos);
}

TEST(Beams, BetweenTwoGasesAreKeptByTheWallsOfBoth) {
  EXPECT_EQ(mistake_in(text_of_file(FSI_ROOT "/configs/piston_between_gases.yaml"), {}, {"piston=beam"}), "");
}

TEST(RemarksOnACase, OfARingInWhichNoGasIsComputed) {
  const std::string ring = R"(time: {end: 1}
grid: {factor: 10}
fluid:
  p_e: 1
  grid: {x: [-1, 1], y: [-1, 1], spacing: h}
  boundary: {left: outflow, right: outflow, bottom: outflow, top: outflow}
  initial: {rho: 1, v: [0, 0], p: "r < 0.4 ? 3 : 1"}
solids:
  balloon:
    law: beam
    rho: 930
    E: 20
    nu: 0.4
    shape: {kind: circle, radius: 0.41}
    beam: {closed: true, thickness: 0.02, line: [[0.4, 0], [0.283, 0.283], [0, 0.4], [-0.283, 0.283], [-0.4, 0], [-0.283, -0.283], [0, -0.4], [0.283, -0.283]]}
)";
  const std::vector<std::string> remarks = remarks_on(tests::load_text(ring));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_NE(remarks.front().find("solids.balloon: no gas is computed inside this ring"), std::string::npos)
      << remarks.front();
}

}  // namespace
}  // namespace fsi
