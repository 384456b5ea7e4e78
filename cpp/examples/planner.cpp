// A motion among obstacles, planned by OMPL's RRT-Connect with the exact distances of urdd.
//   planner URDD [SECONDS]

#include <cstdlib>
#include <iostream>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>
#include <urdd.hpp>

namespace ob = ompl::base;
namespace og = ompl::geometric;

int main(int count, char **words) {
    if (count < 2) {
        std::cerr << "usage: planner URDD [SECONDS]\n";
        return 2;
    }
    const double seconds = count > 2 ? std::atof(words[2]) : 10.0;
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    ompl::RNG::setSeed(1);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    const std::size_t dofs = robot.num_dofs();

    // The floor, and two posts to move around.
    std::vector<urdd::Obstacle> obstacles;
    obstacles.push_back(urdd::Obstacle::cuboid("floor", urdd::translation(0, 0, -0.05), {2, 2, 0.05})
                            .ignoring(robot.link_names().front()));
    obstacles.push_back(urdd::Obstacle::cylinder("post", urdd::translation(0.5, 0.35, 0.4), 0.05, 0.4));
    obstacles.push_back(urdd::Obstacle::cylinder("other post", urdd::translation(0.5, -0.35, 0.4), 0.05, 0.4));
    const urdd::Proximity proximity = robot.proximity();
    const urdd::WorldProximity world = proximity.world_proximity(obstacles);
    const auto is_free = [&](urdd::Span<const double> q) {
        return !world.in_collision(q) && !proximity.in_collision(q);
    };

    auto space = std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned>(dofs));
    ob::RealVectorBounds bounds(static_cast<unsigned>(dofs));
    const auto limits = robot.bounds();
    for (unsigned dof = 0; dof < dofs; ++dof) {
        bounds.setLow(dof, limits[dof][0]);
        bounds.setHigh(dof, limits[dof][1]);
    }
    space->setBounds(bounds);

    // The first free sample, and the first that cannot be reached from it in a straight line.
    const auto is_blocked = [&](const std::vector<double> &from, const std::vector<double> &to) {
        std::vector<double> q(dofs);
        for (int step = 0; step <= 200; ++step) {
            for (std::size_t dof = 0; dof < dofs; ++dof)
                q[dof] = from[dof] + (to[dof] - from[dof]) * step / 200.0;
            if (!is_free(q)) return true;
        }
        return false;
    };
    std::vector<std::vector<double>> ends;
    for (std::uint64_t k = 0; ends.size() < 2 && k < 10000; ++k) {
        const std::vector<double> q = robot.random(k);
        if (is_free(q) && (ends.empty() || is_blocked(ends[0], q))) ends.push_back(q);
    }
    if (ends.size() < 2) {
        std::cerr << "every free sample can be reached in a straight line\n";
        return 1;
    }

    og::SimpleSetup setup(space);
    setup.setStateValidityChecker([&](const ob::State *state) {
        const auto *q = state->as<ob::RealVectorStateSpace::StateType>();
        return is_free({q->values, dofs});
    });
    setup.getSpaceInformation()->setStateValidityCheckingResolution(0.005);
    ob::ScopedState<> start(space), goal(space);
    for (unsigned dof = 0; dof < dofs; ++dof) {
        start[dof] = ends[0][dof];
        goal[dof] = ends[1][dof];
    }
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
    if (setup.solve(seconds) != ob::PlannerStatus::EXACT_SOLUTION) {
        std::cerr << "no path was found in " << seconds << " s\n";
        return 1;
    }
    setup.simplifySolution();

    // Checked again, finer than the planner did.
    og::PathGeometric path = setup.getSolutionPath();
    path.interpolate(5000);
    for (const ob::State *state : path.getStates()) {
        if (!is_free({state->as<ob::RealVectorStateSpace::StateType>()->values, dofs})) {
            std::cerr << "the path collides\n";
            return 1;
        }
    }
    std::cout << "a path of " << setup.getSolutionPath().getStateCount() << " states, in "
              << setup.getLastPlanComputationTime() << " s, free in " << path.getStateCount() << " places\n";
}
