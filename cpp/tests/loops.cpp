// Kinematic loops of a four-bar, held to the law of cosines. Built with the address and undefined-behaviour sanitizers
// by .ci/cpp.

#include "check.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <urdd.hpp>

namespace {

/// The circles about the crank's end and about the rocker's hinge meet in two points, of which `side` chooses one.
std::vector<double> at(double crank, double side) {
    const double ground = 0.4, first = 0.12, coupler = 0.35, rocker = 0.25;
    const double x = ground - first * std::cos(crank), y = -first * std::sin(crank), far = std::hypot(x, y);
    const double cosine = (rocker * rocker + far * far - coupler * coupler) / (2 * rocker * far);
    const double turned = std::atan2(-y, -x) + side * std::acos(cosine);
    const double along = std::atan2(rocker * std::sin(turned) - first * std::sin(crank),
                                    ground + rocker * std::cos(turned) - first * std::cos(crank));
    return {crank, along - crank, turned};
}

void closing(const urdd::Robot &robot) {
    CHECK(robot.loop_names() == std::vector<std::string>{"pin"} && robot.coupling_names().empty());
    CHECK(robot.independent_dofs() == std::vector<std::size_t>{robot.dof("crank")});
    CHECK(robot.loop_errors(robot.reference_configuration()).is_closed);
    const std::vector<double> expected = at(0.7, -1);
    std::vector<double> near = expected;
    near[1] += 1e-3;
    const urdd::LoopErrors errors = robot.loop_errors(near);
    CHECK(!errors.is_closed && errors.sums.empty());
    CHECK(std::abs(errors.gaps[0].position - 0.7 * std::sin(0.5e-3)) < 1e-15 && errors.gaps[0].rotation < 1e-15);
    const urdd::Closed found = robot.close(near, {0});
    CHECK(found.is_closed && found.configuration[0] == near[0]);
    CHECK(std::abs(found.configuration[2] - expected[2]) < 1e-9);
    const urdd::ClosedBatch batch = robot.close_batch({near.data(), 1, 3}, {0});
    CHECK(batch.configurations == found.configuration && batch.is_closed[0]);
    const double most = 9.0;
    CHECK(!robot.close(near, {0}, {{-most, most}, {-most, most}, {expected[2] + 1, most}}).is_closed);
}

void equations(const urdd::Robot &robot) {
    const std::vector<double> q = at(0.7, -1), one{1.0};
    const std::vector<double> jacobian = robot.loop_jacobian(q);
    CHECK(robot.num_loop_equations() == 5 && jacobian.size() == 15 && robot.loop_residuals(q).size() == 5);
    const auto velocities = robot.loop_velocities(q, one);
    CHECK(velocities && velocities->at(0) == 1.0);
    const double step = 1e-6, rocker = (at(0.7 + step, -1)[2] - at(0.7 - step, -1)[2]) / (2 * step);
    CHECK(std::abs(velocities->at(2) - rocker) < 1e-8);
    for (std::size_t row = 0; row < 5; ++row) {
        double moved = 0;
        for (std::size_t dof = 0; dof < 3; ++dof) {
            moved += jacobian[5 * dof + row] * velocities->at(dof);
        }
        CHECK(std::abs(moved) < 1e-12);
    }
    CHECK((robot.free_dofs(q) == std::vector<bool>{true, false, false}));
}

void ways(const urdd::Robot &robot) {
    const std::vector<double> start = at(0.3, -1), end = at(1.5, -1), other = at(1.5, 1);
    const std::size_t rocker = robot.link("rocker_link");
    const urdd::Inverse found = robot.inverse_kinematics(rocker, robot.link_poses(end)[rocker], start);
    CHECK(found.is_reached() && robot.loop_errors(found.configuration).is_closed);
    const urdd::Proximity shapes = robot.proximity(urdd::ShapeKind::hulls);
    CHECK(shapes.motion(start, end).obstruction == URDD_OBSTRUCTION_NONE);
    CHECK(shapes.motion(start, other).obstruction == URDD_OBSTRUCTION_BRANCH);
    CHECK(shapes.motion(start, other, 0.0, 0.0, true).obstruction == URDD_OBSTRUCTION_NONE);
    CHECK(shapes.blocked_edge(start, other) == 1.0 && !shapes.first_contact(start, end).is_blocked());
}

} // namespace

int main(int count, char **words) {
    CHECK(count == 2);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    closing(robot);
    equations(robot);
    ways(robot);
    std::puts("loops: ok");
}
