// A motion among obstacles to a pose that a person would choose, planned by OMPL's RRT-Connect with the exact distances
// of urdd: the goal is the inverse kinematics nearest to the start, within half a turn of it.
//   planner URDD [TIP [SECONDS]]      TIP: the link that goes somewhere; without, the last of the longest arm

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>
#include <urdd.hpp>

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Q = std::vector<double>;

namespace {

/// The robot among its obstacles.
struct Scene {
    urdd::Proximity itself;
    urdd::WorldProximity world;

    bool is_free(urdd::Argument<const double> q) const { return !world.in_collision(q) && !itself.in_collision(q); }
    bool is_free(urdd::Argument<const double> from, urdd::Argument<const double> to) const {
        return std::isnan(world.blocked_edge(from, to, 0, 0.01)) && std::isnan(itself.blocked_edge(from, to, 0, 0.01));
    }
};

/// Whole motions are asked of urdd, in place of the states between their ends.
class Edges : public ob::MotionValidator {
public:
    Edges(const ob::SpaceInformationPtr &space, const Scene &scene) : ob::MotionValidator(space), scene_(scene) {}

    bool checkMotion(const ob::State *from, const ob::State *to) const override {
        return scene_.is_free(values(from), values(to));
    }
    /// Also gives the last state before the first contact.
    bool checkMotion(const ob::State *from, const ob::State *to, std::pair<ob::State *, double> &last) const override {
        double part = 1;
        const auto look = [&](const urdd::FirstContact &contact) {
            if (contact.is_blocked()) part = std::min(part, contact.free);
            return contact.is_blocked();
        };
        const bool blocked = look(scene_.world.first_contact(values(from), values(to)));
        if (!look(scene_.itself.first_contact(values(from), values(to))) && !blocked) return true;
        last.second = part;
        if (last.first != nullptr) si_->getStateSpace()->interpolate(from, to, part, last.first);
        return false;
    }

private:
    urdd::Span<const double> values(const ob::State *state) const {
        return {state->as<ob::RealVectorStateSpace::StateType>()->values, si_->getStateDimension()};
    }
    const Scene &scene_;
};

/// The link that most DOFs move against the first one.
std::size_t tip_of(const urdd::Robot &robot) {
    std::size_t found = 0;
    for (std::size_t link = 1; link < robot.num_links(); ++link) {
        if (robot.dofs_between(0, link).size() > robot.dofs_between(0, found).size()) found = link;
    }
    return found;
}

} // namespace

int main(int count, char **words) {
    if (count < 2) {
        std::cerr << "usage: planner URDD [TIP [SECONDS]]\n";
        return 2;
    }
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    ompl::RNG::setSeed(1);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    const std::size_t dofs = robot.num_dofs();
    const std::size_t tip = count > 2 ? robot.link(words[2]) : tip_of(robot);
    const double seconds = count > 3 ? std::atof(words[3]) : 20.0;

    // The floor, and two posts to move around.
    const urdd::Proximity itself = robot.proximity();
    const Scene scene{itself,
                      itself.world_proximity(
                          {urdd::Obstacle::cuboid("floor", urdd::translation(0, 0, -0.05), {2, 2, 0.05})
                               .ignoring(robot.link_names()[0]),
                           urdd::Obstacle::cylinder("post", urdd::translation(0.5, 0.35, 0.4), 0.05, 0.4),
                           urdd::Obstacle::cylinder("other post", urdd::translation(0.5, -0.35, 0.4), 0.05, 0.4)})};

    // From the middle of the bounds, or the first sample that is free.
    Q start = robot.middle();
    for (std::uint64_t k = 0; k < 1000 && !scene.is_free(start); ++k)
        start = robot.random(k);

    // A goal is a pose of the tip; of the configurations that have it, the nearest to the start, and none that is a
    // turn apart: joints of a UR5 turn twice around, and between such ends there is often no way.
    urdd::InverseSettings settings;
    settings.free_of = scene.itself;
    settings.free_of_world = scene.world;
    settings.posture = start;
    settings.bounds = robot.bounds();
    const std::vector<std::string> units = robot.dof_units();
    const double half_turn = std::acos(-1.0);
    for (std::size_t dof = 0; dof < dofs; ++dof) {
        auto &[low, high] = settings.bounds[dof];
        if (units[dof] != "rad") continue;
        low = std::max(low, start[dof] - half_turn);
        high = std::min(high, start[dof] + half_turn);
    }
    auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(dofs));
    ob::RealVectorBounds bounds(static_cast<unsigned>(dofs));
    for (unsigned dof = 0; dof < dofs; ++dof) {
        bounds.setLow(dof, settings.bounds[dof][0]);
        bounds.setHigh(dof, settings.bounds[dof][1]);
    }
    space->setBounds(bounds);

    // Where one goal has no path in its time, the next is tried: which configuration has the pose decides it.
    const int goals = 5;
    int tried = 0;
    for (std::uint64_t k = 0; k < 1000 && tried < goals; ++k) {
        const urdd::Pose pose = robot.link_poses(robot.random(k))[tip];
        const urdd::Inverse found = robot.inverse_kinematics(tip, pose, start, settings);
        const Q &goal = found.configuration;
        if (!found.is_reached() || scene.is_free(start, goal)) continue; // out of reach, or a straight line does
        ++tried;

        og::SimpleSetup setup(space);
        setup.setStateValidityChecker([&](const ob::State *state) {
            return scene.is_free({state->as<ob::RealVectorStateSpace::StateType>()->values, dofs});
        });
        setup.getSpaceInformation()->setMotionValidator(std::make_shared<Edges>(setup.getSpaceInformation(), scene));
        ob::ScopedState<> from(space), to(space);
        for (unsigned dof = 0; dof < dofs; ++dof) {
            from[dof] = start[dof];
            to[dof] = goal[dof];
        }
        setup.setStartAndGoalStates(from, to);
        setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
        if (setup.solve(seconds / goals) != ob::PlannerStatus::EXACT_SOLUTION) continue;
        setup.simplifySolution();

        // Checked again, in other places than the planner did.
        og::PathGeometric path = setup.getSolutionPath();
        const std::size_t states = path.getStateCount();
        path.interpolate(2000);
        for (const ob::State *state : path.getStates()) {
            if (!scene.is_free({state->as<ob::RealVectorStateSpace::StateType>()->values, dofs})) {
                std::cerr << "the path collides\n";
                return 1;
            }
        }
        std::cout << robot.link_names()[tip] << ": goal " << tried << ", a path of " << states << " states, in "
                  << setup.getLastPlanComputationTime() << " s, free in " << path.getStateCount() << " places\n";
        return 0;
    }
    std::cerr << "no path was found to " << tried << " goals in " << seconds
              << " s: give more seconds, another tip, or goals that are nearer\n";
    return 1;
}
