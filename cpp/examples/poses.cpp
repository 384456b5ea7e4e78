// Forward kinematics, compared with the samples that the URDD itself carries.
//   poses URDD

#include <algorithm>
#include <cmath>
#include <iostream>
#include <urdd.hpp>
#include <urdd_types.hpp>

int main(int count, char **words) {
    if (count != 2) {
        std::cerr << "usage: poses URDD\n";
        return 2;
    }
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    const auto samples = urdd::types::read_module<urdd::types::KinematicsSamplesModule>(words[1]).samples;

    double farthest = 0;
    for (const urdd::types::KinematicsSample &sample : samples) {
        const std::vector<urdd::Pose> poses = robot.link_poses(sample.configuration);
        for (std::size_t link = 0; link < poses.size(); ++link) {
            const urdd::types::Pose &known = sample.link_poses[link];
            const auto [w, x, y, z] = known.quaternion_wxyz;
            const double rotation[3][3] = {
                {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
            };
            for (std::size_t row = 0; row < 3; ++row) {
                farthest = std::max(farthest, std::abs(poses[link][4 * row + 3] - known.position[row]));
                for (std::size_t column = 0; column < 3; ++column) {
                    farthest = std::max(farthest, std::abs(poses[link][4 * row + column] - rotation[row][column]));
                }
            }
        }
    }
    std::cout << samples.size() << " samples, " << robot.num_links() << " links: at most " << farthest << " apart\n";
    return farthest < 1e-9 ? 0 : 1;
}
