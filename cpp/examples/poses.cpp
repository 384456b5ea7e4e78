// Forward kinematics, compared with the samples that the URDD itself carries.
//   poses URDD

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <urdd.hpp>

int main(int count, char **words) {
    if (count != 2) {
        std::cerr << "usage: poses URDD\n";
        return 2;
    }
    const std::string folder = words[1];
    const urdd::Robot robot = urdd::Robot::open(folder);
    std::ifstream file(folder + "/kinematics_samples_module/module.json");
    const auto samples = nlohmann::json::parse(file).at("samples");

    double farthest = 0;
    for (const auto &sample : samples) {
        const auto q = sample.at("configuration").get<std::vector<double>>();
        const std::vector<urdd::Pose> poses = robot.link_poses(q);
        for (std::size_t link = 0; link < poses.size(); ++link) {
            const auto &known = sample.at("link_poses").at(link);
            const auto quaternion = known.at("quaternion_wxyz").get<std::array<double, 4>>();
            const auto [w, x, y, z] = quaternion;
            const double rotation[3][3] = {
                {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
            };
            for (std::size_t row = 0; row < 3; ++row) {
                const double at = known.at("position").at(row);
                farthest = std::max(farthest, std::abs(poses[link][4 * row + 3] - at));
                for (std::size_t column = 0; column < 3; ++column) {
                    farthest = std::max(farthest, std::abs(poses[link][4 * row + column] - rotation[row][column]));
                }
            }
        }
    }
    std::cout << samples.size() << " samples, " << robot.num_links() << " links: at most " << farthest << " apart\n";
    return farthest < 1e-9 ? 0 : 1;
}
