// Probes without a value, and laws that a case cannot have.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "common/core/failure.hpp"
#include "tests/unit/case/cases.hpp"

namespace fsi {
namespace {

/// The message of a case of configs/, "" where it is fine.
std::string mistake_of(const std::string& name, const std::vector<std::string>& overrides,
                       const std::vector<std::string>& laws = {}) {
  try {
    load_case(name, overrides, laws);
    return "";
  } catch (const UserMistake& mistake) {
    return mistake.what();
  }
}

std::string disk_probe(const std::string& in, const std::string& x, const std::string& y) {
  return mistake_of("rotating_disk",
                    {"output.probes=[{name: a, in: " + in + ", x: " + x + ", y: " + y + "}]"});
}

/// A rigid body alone; `more`: keys of its own.
std::string rigid_alone(const std::string& more, const std::string& time = "end: 2") {
  return tests::mistake_in(
      fmt::format("time: {{{}}}\nsolids:\n  body:\n    law: rigid\n    rho: 1\n{}", time, more));
}

TEST(StartOfASolid, IsFiniteAndLeavesTheOutlineWhereTheGasHasIt) {
  const auto ellipse = [](const std::string& value) {
    return mistake_of("shock_ellipse", {"solids.ellipse." + value});
  };
  EXPECT_EQ(ellipse("initial={v: [0.1 * x, 0]}"), "");
  EXPECT_NE(ellipse("initial={v: [sqrt(x), 0]}").find("initial: is (-nan, 0) at ("), std::string::npos)
      << ellipse("initial={v: [sqrt(x), 0]}");
  EXPECT_NE(ellipse("body_force=[0, 1 / (x - x)]").find("solids.ellipse.body_force: is (0, "),
            std::string::npos);
  const std::string moved = ellipse("initial={u: [0.1, 0]}");
  EXPECT_NE(moved.find("initial: moves the outline by (0.1, 0) at ("), std::string::npos) << moved;
  EXPECT_EQ(ellipse("initial={u: [0, 0]}"), "");
}

TEST(StartOfASolid, OfAFixedBodyHasNoVelocity) {
  const std::string message =
      mistake_of("rigid_piston", {"solids.solid.motion=fixed", "solids.solid.initial={v: [0, 0]}"});
  EXPECT_NE(message.find("the body is fixed"), std::string::npos) << message;
}

TEST(StateOfABoundary, IsLookedAtUntilTheEnd) {
  const std::string message = mistake_of(
      "sod_tube", {"fluid.boundary.left={kind: imposed, state: {rho: 1, v: [0, 0], p: 1 - 10 * t}}"});
  EXPECT_NE(message.find("fluid.boundary.left: is "), std::string::npos) << message;
  EXPECT_NE(message.find("must be > 0"), std::string::npos) << message;
}

TEST(StateOfABoundary, IsLookedAtUntilTheEndBesideASolidToo) {
  const auto piston = [](const std::string& side, const std::string& p) {
    return mistake_of(
        "rigid_piston",
        {fmt::format("fluid.boundary.{}={{kind: far_field, state: {{rho: 1, v: [0, 0], p: {}}}}}", side, p)});
  };
  EXPECT_NE(piston("right", "1 - 10 * t").find("fluid.boundary.right: is "), std::string::npos)
      << piston("right", "1 - 10 * t");
  EXPECT_NE(piston("right", "1 - 10 * t * y").find("fluid.boundary.right: is "),
            std::string::npos);  // stands opposite to the piston
  // The piston moves the places of this side: what is the same at all of them can be looked at.
  EXPECT_NE(piston("top", "1 - 10 * t").find("fluid.boundary.top: is "), std::string::npos)
      << piston("top", "1 - 10 * t");
  EXPECT_EQ(piston("top", "1 - 10 * t * (x < -1e9)"), "");
}

TEST(CaseProbe, OutsideTheGasIsRefusedAndOnItsRimFine) {
  EXPECT_NE(disk_probe("fluid", "-10", "0").find("output.probes: (-10, 0) lies outside fluid.grid"),
            std::string::npos);
  EXPECT_EQ(disk_probe("fluid", "-2", "0"), "");
  EXPECT_EQ(disk_probe("fluid", "2", "2"), "");
}

TEST(CaseProbe, RoundOffIsThatOfTheGridsSize) {
  const auto probe = [](const std::string& x) {
    return mistake_of("isentropic_vortex",
                      {"grid.factor=1e6", "fluid.grid={x: [0, 1e-6], y: [0, 1e-6], spacing: h}",
                       "time.end=1e-9", "output={probes: [{name: a, in: fluid, x: " + x + ", y: 5e-7}]}"});
  };
  EXPECT_EQ(probe("1e-6"), "");
  EXPECT_NE(probe("1.001e-6").find("lies outside fluid.grid"), std::string::npos) << probe("1.001e-6");
}

TEST(CaseProbe, OfTheGasWithinABodyIsRefusedWithTheNameOfTheBody) {
  const std::string message = disk_probe("fluid", "0.9", "0");
  EXPECT_NE(message.find("(0.9, 0) lies in solid `disk` at t = 0"), std::string::npos) << message;
  EXPECT_NE(message.find("write `in: disk`"), std::string::npos) << message;
  EXPECT_EQ(disk_probe("fluid", "1.1", "0"), "");
}

TEST(CaseProbe, OfASolidOutsideItsShapeIsRefused) {
  // In the box of the core, but not in the disk.
  const std::string message = disk_probe("disk", "0.9", "0.9");
  EXPECT_NE(message.find("(0.9, 0.9) lies outside solid `disk`"), std::string::npos) << message;
  EXPECT_EQ(disk_probe("disk", "0.9", "0"), "");
}

TEST(CaseProbe, OfASolidOutsideItsGridIsRefused) {
  const std::string probe = "output.probes=[{name: a, in: block, x: 0.5, y: 0.5}]";
  const std::string message = mistake_of("template", {probe});
  EXPECT_NE(message.find("(0.5, 0.5) lies outside solid `block`"), std::string::npos) << message;
}

TEST(CaseProbe, OfABeamIsInItsBody) {
  const auto probe = [](const char* name, const char* solid, const std::string& place) {
    return mistake_of(name, {fmt::format("output.probes=[{{name: a, in: {}, {}}}]", solid, place)});
  };
  for (const char* place : {"x: 0, y: 0", "x: 0, y: 50", "x: 0.5, y: 20", "x: 0.2, y: 7"})
    EXPECT_EQ(probe("shocked_panel", "panel", place), "") << place;
  for (const char* place : {"x: 0, y: 51", "x: 2, y: 20", "x: 0, y: -1"}) {
    const std::string message = probe("shocked_panel", "panel", place);
    EXPECT_NE(
        message.find("lies outside solid `panel` in its reference configuration; move it into the body"),
        std::string::npos)
        << place << message;
  }
  EXPECT_EQ(probe("plate", "plate", "x: 0, y: 0.01"), "");
  EXPECT_NE(probe("plate", "plate", "x: 0.1, y: 0.01").find("(0.1, 0.01) lies outside solid `plate`"),
            std::string::npos);
}

TEST(CaseProbe, BesideABeamOnAWallIsInTheGas) {
  EXPECT_EQ(mistake_of("beam", {"output.probes=[{name: a, in: fluid, x: 0.2, y: 0.5}]"}), "");
  EXPECT_NE(
      mistake_of("beam", {"output.probes=[{name: a, in: fluid, x: 0, y: 0.5}]"}).find("in solid `beam`"),
      std::string::npos);
}

TEST(CaseLaw, ReferenceThatNeedsDeformationRefusesARigidSolid) {
  const std::string message = mistake_of("rotating_disk", {}, {"disk=rigid"});
  EXPECT_TRUE(message.starts_with("--solid disk=rigid: ")) << message;
  EXPECT_NE(message.find("reference `rotating_disk` is computed with a law of deformation"),
            std::string::npos)
      << message;
}

TEST(CaseLaw, ClampedSolidCannotBeRigid) {
  const std::string message = mistake_of("beam", {}, {"beam=rigid"});
  EXPECT_NE(message.find("beam.yaml:"), std::string::npos) << message;
  EXPECT_NE(message.find("solids.beam.boundary.bottom: a rigid solid cannot have its motion given"),
            std::string::npos)
      << message;
  EXPECT_EQ(mistake_of("beam", {"solids.beam.boundary.bottom=slip_wall"}, {"beam=rigid"}), "");
}

TEST(CaseLaw, WhatIsScaledOfTheDissipationMustLeaveAStableStep) {
  const auto told = [](const char* setting) {
    return mistake_of("elastic_piston", {std::string("solids.solid.scheme.") + setting});
  };
  EXPECT_EQ(told("relaxation={scaled: 1.9}"), "");
  for (const char* setting : {"relaxation={scaled: 2}", "tangential_stress={scaled: 2.5}"})
    EXPECT_NE(told(setting).find(
                  "solids.solid.scheme: the `scaled` part of tangential_stress and relaxation together"),
              std::string::npos)
        << setting;
  EXPECT_NE(
      told("displacement={scaled: 2}").find("the `scaled` part of displacement must be less than 2, is 2"),
      std::string::npos);
}

TEST(CaseLaw, ABeamNeedsItsSectionAndHasAMotionOfItsOwn) {
  EXPECT_EQ(mistake_of("plate", {}), "");
  const auto refused = [](const std::vector<std::string>& settings, const char* words) {
    const std::string message = mistake_of("plate", settings);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  refused({"solids.plate.beam.line=[[0, 0]]"}, "solids.plate.beam.line: give two points");
  refused({"solids.plate.beam.line=[[0, 0], [0, 0]]"}, "point 2 is the one before it again");
  const std::string ring = "solids.plate.beam.line=[[0, 0], [0, 1], [1, 1], [1, 0], [1e-12, 0]]";
  refused({ring, "solids.plate.beam.ends=[clamped, free]"},
          "for a ring write `closed: true` and leave this point out");
  refused(
      {ring,
       "solids.plate.beam={closed: true, line: [[0, 0], [0, 1], [1, 1], [1, 0], [0, 0]], thickness: 0.1}"},
      "a ring closes by itself; leave out its last point");
  refused({"solids.plate.beam.ends=[guided]"}, "solids.plate.beam.ends: must be two words");
  refused({"solids.plate.beam.thickness=0.1 * (1 + t)"}, "solids.plate.beam.thickness: must not depend on t");
  refused({"solids.plate.boundary.left={kind: traction, value: [1, 0]}"},
          "solids.plate.boundary.left: a beam cannot have its traction given at a side");
  refused({"solids.plate.boundary.left={kind: displacement, value: [t, 0]}"},
          "solids.plate.boundary.left: a beam cannot have its motion given at a side");
  refused({"solids.plate.beam.ends=[guided, welded]"},
          "solids.plate.beam.ends: `welded` does not exist here");
  refused({"solids.plate.beam.elements=2"}, "solids.plate.beam.elements");
  refused({"interface.projection=traditional"}, "traditional is not there for the beam `plate`");
  refused({"solids.plate.initial={u: [0, x]}"}, "a beam may begin with `v`, and nothing else");
  EXPECT_NE(mistake_of("rotating_disk", {}, {"disk=beam"}).find("law `beam` needs the section `beam:"),
            std::string::npos);
  EXPECT_EQ(mistake_of("beam", {}, {"beam=beam"}), "");
}

TEST(CaseLaw, ARigidBodyBetweenCrossingWaysCannotMove) {
  const std::string left = "solids.solid.boundary.left=slip_wall";
  const std::string message = mistake_of("rigid_piston", {left});
  EXPECT_NE(
      message.find(
          "solids.solid.boundary.bottom: this side and another one let the body slide along different walls"),
      std::string::npos)
      << message;
  EXPECT_EQ(mistake_of("rigid_piston", {left, "solids.solid.motion=fixed"}), "");
  EXPECT_EQ(mistake_of("rigid_piston", {"parameters.angle=30"}), "");
}

TEST(CaseLaw, ARigidBodySlidesAlongAStraightWallOnly) {
  const auto on_floor = [](const char* floor, const char* motion = "free") {
    return rigid_alone(fmt::format(
        "    motion: {}\n"
        "    grid: {{kind: mapped, points: [21, 11], map: [r - 1, \"0.5 * s + (1 - s) * ({})\"]}}\n"
        "    boundary: {{left: free, right: free, bottom: slip_wall, top: free}}\n",
        motion, floor));
  };
  EXPECT_EQ(on_floor("0"), "");
  EXPECT_EQ(on_floor("0.2 * r"), "");
  EXPECT_EQ(on_floor("-0.1 * sin(pi * r)", "fixed"), "");
  for (const char* floor : {"-0.1 * sin(pi * r)", "1e-6 * sin(2 * pi * r)"})
    EXPECT_NE(on_floor(floor).find("solids.body.boundary.bottom: the body slides along a wall that is not "
                                   "straight, so that it cannot move; write `motion: fixed`, or free"),
              std::string::npos)
        << on_floor(floor);
}

TEST(CaseLaw, ARigidBodyIsHeldWhereItMayMove) {
  const auto held = [](const std::string& more) {
    return rigid_alone(
        "    grid: {x: [0, 1], y: [0, 1], points: [11, 11]}\n"
        "    boundary: {left: free, right: free, top: free, bottom: free}\n" +
            more,
        "end: 2, dt: 0.01");
  };
  const auto refused = [&](const std::string& more, const std::string& why) {
    EXPECT_NE(held(more).find(why), std::string::npos) << held(more);
  };
  const std::string pitch = "    degrees_of_freedom: [rotation]\n    pivot: [2, 0.5]\n";
  EXPECT_EQ(held(pitch + "    spring: {rotation: 3}\n    damper: {rotation: 0.1, x: 0}\n"), "");
  refused(pitch + "    spring: {y: 3}\n",
          "solids.body.spring.y: `y` is not among the `degrees_of_freedom`; add it there, or leave this out");
  refused("    degrees_of_freedom: []\n", "leaves no motion; write `motion: fixed`");
  refused("    degrees_of_freedom: [x, x]\n", "`x` stands there twice");
  refused("    degrees_of_freedom: [z]\n", "`z` does not exist here (one of x, y, rotation)");
  for (const char* key : {"pivot: [0, 0]", "degrees_of_freedom: [x]", "spring: {x: 1}", "damper: {x: 1}"})
    refused(fmt::format("    motion: fixed\n    {}\n", key), "the body is fixed (`motion: fixed`)");
  EXPECT_NE(
      mistake_of("beam", {"solids.beam.spring={x: 1}"}).find("solids.beam.spring: belongs to `law: rigid`"),
      std::string::npos);
}

TEST(CaseLaw, WhatSlidesAlongAWallIsHeldAlongItAlone) {
  const auto refused = [](const std::string& key, const char* value, const char* out) {
    const std::string message = mistake_of("rigid_piston", {fmt::format("solids.solid.{}={}", key, value)});
    EXPECT_NE(message.find(fmt::format("solids.solid.{}: the body slides along a wall", key)),
              std::string::npos)
        << message;
    EXPECT_NE(message.find(fmt::format("leave `{}` out", out)), std::string::npos) << message;
  };
  EXPECT_EQ(mistake_of("rigid_piston", {"solids.solid.spring={x: 1}", "solids.solid.damper={x: 1}"}), "");
  refused("spring", "{rotation: 1}", "rotation");
  refused("damper", "{rotation: 1}", "rotation");
  refused("pivot", "[0, 0]", "pivot");
  refused("degrees_of_freedom", "[x]", "degrees_of_freedom");
}

TEST(CaseLaw, TheMotionOfARigidBodyIsGivenByFormulasOfTimeThatBeginAtZeroAndDoNotJump) {
  const auto given = [](const std::string& motion, const std::string& more = "") {
    return rigid_alone(
        "    grid: {x: [0, 1], y: [0, 1], points: [11, 11]}\n"
        "    boundary: {left: free, right: free, top: free, bottom: free}\n"
        "    motion: " +
            motion + "\n" + more,
        "end: 2, dt: 0.01");
  };
  const auto refused = [&](const std::string& motion, const std::string& why, const std::string& more = "") {
    EXPECT_NE(given(motion, more).find(why), std::string::npos) << given(motion, more);
  };
  EXPECT_EQ(given("{x: 0.1 * sin(t), rotation: t^2}", "    degrees_of_freedom: [y]\n    spring: {y: 1}\n"),
            "");
  for (const char* steep :
       {"tanh(200 * (t - 1)) + tanh(200)", "'t < 1 ? 0 : t - 1'", "sqrt(t)", "sin(500 * t)"})
    EXPECT_EQ(given(fmt::format("{{x: {}}}", steep)), "") << steep;
  refused("{}", "solids.body.motion: says of no motion what it is");
  refused("{z: t}", "unknown key `z`; one of x, y, rotation");
  refused("gone", "(a section of keys, or one of free, fixed)");
  refused("{x: x * t}",
          "solids.body.motion.x: the body moves as a whole: a formula of `t` alone, not of `x`");
  refused("{y: 1 + t}", "solids.body.motion.y: is 1 at t = 0");
  refused("{y: 1 / (t - 1)}", "solids.body.motion.y: is inf at t = 1; must be finite");
  refused("{rotation: 't < 1.2345 ? t : t + 0.02'}",
          "solids.body.motion.rotation: jumps by 0.02 at t = 1.2345;");
  refused("{x: t}", "`x` is given by `motion`, and cannot be free", "    degrees_of_freedom: [y, x]\n");
  refused("{x: t}", "solids.body.spring.y: `y` is not among the `degrees_of_freedom`",
          "    spring: {y: 1}\n");
  EXPECT_NE(
      mistake_of("beam", {"solids.beam.motion={x: t}"}).find("solids.beam.motion: belongs to `law: rigid`"),
      std::string::npos);
}

TEST(CaseLaw, AGivenMotionStaysInItsGasAndOnItsWalls) {
  const auto refused = [](const char* name, const char* motion, const char* why) {
    const bool piston = std::string(name) == "rigid_piston";
    const std::string message =
        mistake_of(name, {fmt::format("solids.{}.motion={}", piston ? "solid" : "ellipse", motion)},
                   piston ? std::vector<std::string>{} : std::vector<std::string>{"ellipse=rigid"});
    EXPECT_NE(message.find(why), std::string::npos) << message;
  };
  EXPECT_EQ(mistake_of("rigid_piston", {"solids.solid.motion={x: 0.1 * t^2}"}), "");
  refused("rigid_piston", "{y: 0.1 * t^2}", "the body slides along a wall in the direction (1, 0)");
  refused("rigid_piston", "{x: t, rotation: t}", "leave `rotation` out");
  EXPECT_EQ(
      mistake_of("shock_ellipse", {"solids.ellipse.motion={x: 0.3 * t, rotation: t}"}, {"ellipse=rigid"}),
      "");
  refused("shock_ellipse", "{x: 3 * t}", "takes the body out of its gas: at t = ");
  refused("shock_ellipse", "{y: -3 * t, rotation: t}", "takes the body out of its gas: at t = ");
}

TEST(CaseLaw, LoadedSideCannotBeRigid) {
  const std::string side = "solids.beam.boundary.bottom={kind: traction, value: [t, 0]}";
  const std::string message = mistake_of("beam", {side}, {"beam=rigid"});
  EXPECT_NE(message.find("a rigid solid cannot carry a load"), std::string::npos) << message;
}

TEST(CaseLaw, ARigidBodyWithoutAGasFollowsItsForceInStepsThatTheCaseGives) {
  const std::string square =
      "    grid: {x: [0, 1], y: [0, 1], points: [11, 11]}\n"
      "    boundary: {left: free, right: free, top: free, bottom: free}\n";
  const std::string force = square + "    body_force: [sin(pi * t), 0]\n";
  EXPECT_EQ(rigid_alone(square), "");
  EXPECT_EQ(rigid_alone(force, "end: 2, dt: 0.01"), "");
  EXPECT_EQ(rigid_alone(force + "    motion: fixed\n"), "");
  EXPECT_NE(
      rigid_alone(force).find("time: the rigid solid `body` without a gas has no largest step of its own, "
                              "with which to follow its `body_force`; write `dt` [time]"),
      std::string::npos)
      << rigid_alone(force);
  const std::string spring = square + "    spring: {x: 3}\n";
  EXPECT_EQ(rigid_alone(spring, "end: 2, dt: 0.01"), "");
  EXPECT_NE(rigid_alone(spring).find("with which to follow what holds it; write `dt` [time]"),
            std::string::npos)
      << rigid_alone(spring);
}

/// With `shape` the load of a side is that of the outline, where neither program looks for one.
TEST(CaseLaw, ABodyThatIsNoContinuumTakesNothingAtItsOutline) {
  const auto disk = [](const std::string& boundary) {
    return rigid_alone(
        fmt::format("    shape: {{kind: circle, radius: 1}}\n    body_fitted: {{boundary: {}}}\n", boundary));
  };
  const auto flap = [](const std::string& boundary) {
    return tests::mistake_in(fmt::format(
        "time: {{end: 2, dt: 0.02}}\nsolids:\n  flap:\n    law: beam\n    rho: 1\n    E: 250\n    nu: 0.25\n"
        "    shape: {{kind: polygon, corners: [[-0.05, 0], [-0.05, 1], [0.05, 1], [0.05, 0]], radius: 0, "
        "walls: [bottom, bottom]}}\n"
        "    body_fitted: {{boundary: {}}}\n"
        "    boundary: {{left: free, right: free, bottom: clamped, top: free}}\n"
        "    beam: {{line: [[0, 0], [0, 1]], thickness: 0.1, elements: 20, ends: [clamped, free]}}\n",
        boundary));
  };
  EXPECT_EQ(disk("free"), "");
  EXPECT_EQ(flap("free"), "");
  for (const char* given : {"{kind: traction, value: [0.01, 0]}",
                            "{kind: displacement, value: [0.1 * t^2, 0]}", "clamped", "slip_wall"}) {
    EXPECT_NE(
        disk(given).find("solids.body.body_fitted.boundary: a rigid solid takes no load, no motion and no "
                         "wall at its outline: write free, and the load as `body_force`"),
        std::string::npos)
        << disk(given);
    EXPECT_NE(
        flap(given).find("solids.flap.body_fitted.boundary: a beam takes no load, no motion and no wall"),
        std::string::npos)
        << flap(given);
  }
}

}  // namespace
}  // namespace fsi
