// Pinocchio: program URDF builds the model; program URDF LINK JOINT=VALUE... prints where the link is.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/parsers/urdf.hpp>

int main(int count, char **words) {
    if (count < 2) return 1;
    pinocchio::Model model;
    pinocchio::urdf::buildModel(words[1], model);
    pinocchio::Data data(model);
    if (count < 3) return 0;
    Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq);
    for (int k = 3; k < count; ++k) {
        const char *value = std::strchr(words[k], '=');
        const auto joint = model.getJointId(std::string(words[k], value - words[k]));
        q[model.joints[joint].idx_q()] = std::atof(value + 1);
    }
    pinocchio::framesForwardKinematics(model, data, q);
    const auto &place = data.oMf[model.getFrameId(words[2])].translation();
    std::printf("\n%.9f %.9f %.9f\n", place[0], place[1], place[2]);
}
