// KDL with kdl_parser: program URDF prints the joints; program URDF LINK JOINT=VALUE... prints where the link is.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl_parser/kdl_parser.hpp>

int main(int count, char **words) {
    KDL::Tree tree;
    if (count < 2 || !kdl_parser::treeFromFile(words[1], tree)) return 1;
    KDL::TreeFkSolverPos_recursive solver(tree);
    KDL::JntArray q(tree.getNrOfJoints());
    if (count < 3) return 0;
    for (int k = 3; k < count; ++k) {
        const char *value = std::strchr(words[k], '=');
        const std::string name(words[k], value - words[k]);
        for (const auto &[_, element] : tree.getSegments())
            if (GetTreeElementSegment(element).getJoint().getName() == name) q(GetTreeElementQNr(element)) = std::atof(value + 1);
    }
    KDL::Frame pose;
    if (solver.JntToCart(q, pose, words[2]) < 0) return 1;
    std::printf("\n%.9f %.9f %.9f\n", pose.p[0], pose.p[1], pose.p[2]);
}
