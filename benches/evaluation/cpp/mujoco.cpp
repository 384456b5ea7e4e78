// MuJoCo: program URDF compiles the model; program URDF LINK JOINT=VALUE... prints where the link is.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <mujoco/mujoco.h>

int main(int count, char **words) {
    char error[1000] = "";
    if (count < 2) return 1;
    mjModel *model = mj_loadXML(words[1], nullptr, error, sizeof error);
    if (!model) return std::fprintf(stderr, "%s\n", error), 1;
    mjData *data = mj_makeData(model);
    if (count < 3) return 0;
    for (int k = 3; k < count; ++k) {
        const char *value = std::strchr(words[k], '=');
        const int joint = mj_name2id(model, mjOBJ_JOINT, std::string(words[k], value - words[k]).c_str());
        data->qpos[model->jnt_qposadr[joint]] = std::atof(value + 1);
    }
    mj_kinematics(model, data);
    const int body = mj_name2id(model, mjOBJ_BODY, words[2]);
    if (body < 0) return std::fprintf(stderr, "no body %s\n", words[2]), 1;
    const mjtNum *place = data->xpos + 3 * body;
    std::printf("\n%.9f %.9f %.9f\n", place[0], place[1], place[2]);
}
