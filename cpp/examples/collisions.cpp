// Self-collisions, the nearest pairs of links, and obstacles.
//   collisions URDD

#include <algorithm>
#include <iostream>
#include <urdd.hpp>

int main(int count, char **words) {
    if (count != 2) {
        std::cerr << "usage: collisions URDD\n";
        return 2;
    }
    try {
        const urdd::Robot robot = urdd::Robot::open(words[1]);
        const std::vector<std::string> links = robot.link_names();
        const urdd::Proximity proximity = robot.proximity(urdd::ShapeKind::pieces);

        // The floor, on which the base may stand, and a ball.
        const urdd::WorldProximity world = proximity.world_proximity(
            {urdd::Obstacle::cuboid("floor", urdd::translation(0, 0, -0.05), {2, 2, 0.05}).ignoring(links.front()),
             urdd::Obstacle::sphere("ball", {0.5, 0, 0.5}, 0.1)});

        const std::vector<double> q = robot.zero();
        for (const urdd_pair_distance &near : proximity.nearest(q, 3)) {
            std::cout << links[near.pair.links[0]] << " and " << links[near.pair.links[1]] << ": " << near.distance
                      << " m\n";
        }
        for (const urdd_obstacle_distance &near : world.nearest(q, 1)) {
            std::cout << links[near.link] << " and obstacle " << near.obstacle << ": " << near.distance << " m\n";
        }

        // A thousand configurations at once, on all processors.
        const std::size_t rows = 1000;
        const std::vector<double> samples = robot.random(0, rows);
        const std::vector<bool> self = proximity.in_collision_batch({samples, robot.num_dofs()});
        const std::vector<bool> others = world.in_collision_batch({samples, robot.num_dofs()});
        std::cout << std::count(self.begin(), self.end(), true) << " of " << rows << " samples collide with the robot, "
                  << std::count(others.begin(), others.end(), true) << " with an obstacle\n";
    } catch (const urdd::Error &error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
