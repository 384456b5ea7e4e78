// The modules that follow from the tree: chain_module (SPEC 6.3), connections_module (6.4) and
// kinematics_samples_module (9). Rotations are unit quaternions w, x, y, z.

#ifndef PRODUCER_KINEMATICS_HPP
#define PRODUCER_KINEMATICS_HPP

#include "urdf.hpp"

#include <cstdint>
#include <limits>

using Vector = std::array<double, 3>;
using Quaternion = std::array<double, 4>;
struct Motion {
    Vector position{};
    Quaternion rotation{1, 0, 0, 0};
};

constexpr double pi = 3.14159265358979323846;

inline Quaternion multiply(const Quaternion &a, const Quaternion &b) {
    return {
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

inline Vector rotate(const Quaternion &q, const Vector &v) {
    const Quaternion r = multiply(multiply(q, {0, v[0], v[1], v[2]}), {q[0], -q[1], -q[2], -q[3]});
    return {r[1], r[2], r[3]};
}

inline Quaternion turn(const Vector &axis, double angle) {
    const double sine = std::sin(angle / 2);
    return {std::cos(angle / 2), sine * axis[0], sine * axis[1], sine * axis[2]};
}

inline Quaternion turn(const Vector &rotation_vector) {
    const auto [x, y, z] = rotation_vector;
    const double angle = std::hypot(x, y, z);
    return angle > 0 ? turn({x / angle, y / angle, z / angle}, angle) : Quaternion{1, 0, 0, 0};
}

inline Motion compose(const Motion &a, const Motion &b) {
    const Vector moved = rotate(a.rotation, b.position);
    return {{a.position[0] + moved[0], a.position[1] + moved[1], a.position[2] + moved[2]},
            multiply(a.rotation, b.rotation)};
}

/// A pose with a quaternion of length 1, whose first part that is not 0 is positive (SPEC 5.4).
inline types::Pose pose(const Motion &motion) {
    const auto &[w, x, y, z] = motion.rotation;
    double length = std::hypot(std::hypot(w, x), std::hypot(y, z));
    for (const double part : {z, y, x, w}) {
        length = part != 0 ? std::copysign(length, part) : length;
    }
    types::Pose pose;
    pose.position = motion.position;
    pose.quaternion_wxyz = {w / length, x / length, y / length, z / length};
    return pose;
}

inline types::JointInChain joint_in_chain(const types::Joint &joint, bool quaternions) {
    types::JointInChain entry;
    const types::Origin origin = joint.origin.value_or(types::Origin{});
    Motion motion{origin.xyz.value_or(Vector{})};
    const Quaternion xyzw = quaternions ? origin.quat_xyzw.value_or(Quaternion{}) : Quaternion{};
    const auto [x, y, z, w] = xyzw;
    if (x * x + y * y + z * z + w * w > 0) { // SPEC 6.1.9
        motion.rotation = {w, x, y, z};
    } else {
        const auto [roll, pitch, yaw] = origin.rpy.value_or(Vector{});
        motion.rotation = multiply(turn({0, 0, 1}, yaw), multiply(turn({0, 1, 0}, pitch), turn({1, 0, 0}, roll)));
    }
    switch (joint.joint_type) {
    case JointType::revolute:
    case JointType::continuous:
    case JointType::prismatic:
    case JointType::planar: {
        const Vector axis = (joint.axis ? joint.axis->xyz : std::nullopt).value_or(Vector{1, 0, 0}); // SPEC 5.7
        const auto [a, b, c] = axis;
        const double squares = a * a + b * b + c * c, length = std::hypot(a, b, c);
        demand(squares >= std::numeric_limits<double>::min() && std::isfinite(squares),
               "the axis of " + joint.name + " has no direction");
        entry.axis = Vector{a / length, b / length, c / length};
        break;
    }
    default: break;
    }
    entry.joint_name = joint.name;
    entry.joint_type = joint.joint_type;
    entry.parent_link_name = joint.parent.link;
    entry.child_link_name = joint.child.link;
    entry.origin = pose(motion);
    return entry;
}

inline types::ChainModule chain_module(const types::UrdfModule &urdf) {
    types::ChainModule chain;
    std::unordered_map<std::string, std::size_t> by_name;
    for (std::size_t index = 0; index < urdf.links.size(); ++index) {
        const std::string &name = urdf.links[index].name;
        demand(by_name.emplace(name, index).second, "two links of the name " + name);
        types::LinkInChain &link = chain.links_in_chain.emplace_back();
        link.name = name;
        link.link_idx = index;
    }
    for (std::size_t index = 0; index < urdf.joints.size(); ++index) {
        types::JointInChain joint = joint_in_chain(urdf.joints[index], has_quaternions(urdf.version));
        const auto parent = by_name.find(joint.parent_link_name), child = by_name.find(joint.child_link_name);
        demand(parent != by_name.end() && child != by_name.end(), joint.joint_name + ": a link of it is not there");
        joint.joint_idx = index;
        joint.parent_link_idx = parent->second;
        joint.child_link_idx = child->second;
        types::LinkInChain &above = chain.links_in_chain[parent->second], &below = chain.links_in_chain[child->second];
        demand(!below.parent_joint_idx, "the link " + below.name + " is the child of two joints");
        above.children_joint_idxs.push_back(index);
        auto &links = above.children_link_idxs;
        links.insert(std::lower_bound(links.begin(), links.end(), child->second), child->second);
        below.parent_joint_idx = index;
        below.parent_link_idx = parent->second;
        chain.joints_in_chain.push_back(std::move(joint));
    }
    std::vector<std::size_t> level;
    for (const types::LinkInChain &link : chain.links_in_chain) {
        if (!link.parent_joint_idx) {
            level.push_back(link.link_idx);
        }
    }
    demand(level.size() == 1, "not a tree with one root");
    chain.root_idx = level[0];
    std::size_t reached = 0;
    while (!level.empty()) {
        reached += level.size();
        std::vector<std::size_t> next;
        for (const std::size_t link : level) {
            const auto &links = chain.links_in_chain[link].children_link_idxs;
            next.insert(next.end(), links.begin(), links.end());
        }
        std::sort(next.begin(), next.end());
        chain.kinematic_hierarchy.push_back(std::exchange(level, std::move(next)));
    }
    demand(reached == urdf.links.size(), "not a tree with one root");
    return chain;
}

/// The links from the root on, each after its parent.
inline std::vector<std::size_t> from_root(const types::ChainModule &chain) {
    std::vector<std::size_t> links;
    for (const auto &level : chain.kinematic_hierarchy) {
        links.insert(links.end(), level.begin(), level.end());
    }
    return links;
}

inline types::ConnectionsModule connections_module(const types::ChainModule &chain) {
    constexpr std::size_t max_links = 300, max_links_in_paths = 2000000; // SPEC 6.4.6
    const std::size_t count = chain.links_in_chain.size();
    types::ConnectionsModule module;
    auto &roots = module.root_paths;
    roots.resize(count);
    for (const std::size_t index : from_root(chain)) {
        const types::LinkInChain &link = chain.links_in_chain[index];
        if (link.parent_link_idx) {
            roots[index].links = roots[*link.parent_link_idx].links;
            roots[index].joints = roots[*link.parent_link_idx].joints;
            roots[index].joints.push_back(*link.parent_joint_idx);
        }
        roots[index].links.push_back(index);
    }
    // How many links two root paths share: the path between two links is what they have below, and the last shared.
    const auto shared = [&](std::size_t i, std::size_t j) {
        const auto &a = roots[i].links, &b = roots[j].links;
        return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    };
    std::size_t in_paths = 0;
    for (std::size_t i = 0; i < count; ++i) {
        auto &row = module.lowest_common_ancestors.emplace_back();
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t n = shared(i, j);
            row.push_back(roots[i].links[n - 1]);
            in_paths += roots[i].links.size() + roots[j].links.size() - 2 * n + 1;
        }
    }
    if (count > max_links || in_paths > max_links_in_paths) {
        return module;
    }
    auto &paths = module.link_to_link_paths.emplace(count);
    auto &connections = module.link_connection_paths.emplace(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            const types::LinkPath &up = roots[i], &down = roots[j];
            const auto n = static_cast<std::ptrdiff_t>(shared(i, j));
            types::LinkPath &path = paths[i].emplace_back();
            path.links.assign(up.links.rbegin(), up.links.rend() - (n - 1));
            path.links.insert(path.links.end(), down.links.begin() + n, down.links.end());
            path.joints.assign(up.joints.rbegin(), up.joints.rend() - (n - 1));
            path.joints.insert(path.joints.end(), down.joints.begin() + (n - 1), down.joints.end());
            auto &descent = connections[i].emplace_back();
            if (i == j) {
                descent = std::vector<std::size_t>{i};
            } else if (n == static_cast<std::ptrdiff_t>(up.links.size())) {
                descent.emplace(down.links.begin() + n, down.links.end());
            }
        }
    }
    return module;
}

inline Motion motion(const types::JointInChain &joint, const std::vector<double> &q) {
    const Vector axis = joint.axis.value_or(Vector{});
    switch (joint.joint_type) {
    case JointType::revolute:
    case JointType::continuous: return {{}, turn(axis, q[0])};
    case JointType::prismatic: return {{q[0] * axis[0], q[0] * axis[1], q[0] * axis[2]}};
    case JointType::planar: {
        // The plane's basis is (ex, ey), turned by the shortest arc from z to the axis (SPEC 5.9).
        const auto [x, y, z] = axis;
        const double w = z > 0 ? 1 + z : (x * x + y * y) / (1 - z); // 1 + z, without loss of digits near -z
        Quaternion arc = z > 0 ? Quaternion{1, 0, 0, 0} : Quaternion{0, 1, 0, 0};
        if (std::hypot(x, y) >= 1e-10) {
            const double length = std::hypot(w, x, y);
            arc = {w / length, -y / length, x / length, 0};
        }
        return {rotate(arc, {q[0], q[1], 0}), turn(axis, q[2])};
    }
    case JointType::floating: return {{q[0], q[1], q[2]}, turn(Vector{q[3], q[4], q[5]})};
    case JointType::spherical: return {{}, turn(Vector{q[0], q[1], q[2]})};
    default: return {};
    }
}

inline std::vector<types::Pose> link_poses(const types::ChainModule &chain, const types::DofModule &dof,
                                           const std::vector<double> &q) {
    std::vector<Motion> motions(chain.links_in_chain.size());
    for (const std::size_t index : from_root(chain)) {
        const types::LinkInChain &link = chain.links_in_chain[index];
        if (!link.parent_joint_idx) {
            continue;
        }
        const types::JointInChain &joint = chain.joints_in_chain[*link.parent_joint_idx];
        std::vector<double> values;
        for (const std::size_t own : dof.joint_idx_to_dof_idxs_mapping[joint.joint_idx]) {
            values.push_back(q[own]);
        }
        if (const auto &mimic = dof.joint_idx_to_mimic_mapping[joint.joint_idx]) {
            values = {mimic->multiplier * (mimic->dof_idx ? q[*mimic->dof_idx] : 0.0) + mimic->offset};
        }
        const Motion origin{joint.origin.position, joint.origin.quaternion_wxyz};
        motions[index] = compose(compose(motions[*link.parent_link_idx], origin), motion(joint, values));
    }
    std::vector<types::Pose> poses;
    for (const Motion &motion : motions) {
        const types::Pose &found = poses.emplace_back(pose(motion));
        for (const double number : found.position) {
            demand(std::isfinite(number), "a pose is not finite");
        }
        demand(std::isfinite(found.quaternion_wxyz[0]), "a pose is not finite");
    }
    return poses;
}

/// Number i of the sampled configuration k, from 0 to 1 (SPEC 9.3).
inline double uniform(std::uint64_t k, std::uint64_t i) {
    std::uint64_t z = ((k << 32U) + i + 1) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * std::ldexp(1.0, -53);
}

inline Vector uniform_rotation_vector(double u1, double u2, double u3) {
    const double a = std::sqrt(u1), b = std::sqrt(1 - u1);
    const double w = a * std::cos(2 * pi * u3);
    const Vector v{b * std::sin(2 * pi * u2), b * std::cos(2 * pi * u2), a * std::sin(2 * pi * u3)};
    const double sine = std::hypot(v[0], v[1], v[2]);
    const double factor = std::copysign(sine > 0 ? 2 * std::atan2(sine, std::abs(w)) / sine : 0.0, w);
    return {factor * v[0], factor * v[1], factor * v[2]};
}

inline types::KinematicsSamplesModule kinematics_samples_module(const types::ChainModule &chain,
                                                                const types::DofModule &dof,
                                                                const types::BoundsModule &bounds) {
    constexpr std::size_t sampled = 16; // any number will do (SPEC 9.2)
    const auto &lower = bounds.dof_lower_bounds, &upper = bounds.dof_upper_bounds;
    types::KinematicsSamplesModule module;
    const auto add = [&](types::ConfigurationKind kind, std::optional<std::size_t> k,
                         const std::function<double(std::size_t)> &value,
                         const std::function<Vector(std::size_t)> &rotation_vector) {
        types::KinematicsSample &sample = module.samples.emplace_back();
        sample.kind = kind;
        sample.sample_idx = k;
        for (std::size_t index = 0; index < dof.num_dofs; ++index) {
            sample.configuration.push_back(value(index));
        }
        for (std::size_t index = 0; index < dof.num_dofs; ++index) {
            if (dof.dofs[index].name == dof.dofs[index].joint_name + "/rot_x") {
                const Vector v = rotation_vector(index);
                std::copy(v.begin(), v.end(), sample.configuration.begin() + static_cast<std::ptrdiff_t>(index));
            }
        }
        sample.link_poses = link_poses(chain, dof, sample.configuration);
    };
    using Kind = types::ConfigurationKind;
    add(Kind::zero, {}, [](std::size_t) { return 0.0; }, [](std::size_t) { return Vector{}; });
    add(
        Kind::middle, {}, [&](std::size_t i) { return (lower[i] + upper[i]) / 2; },
        [](std::size_t) { return Vector{}; });
    add(Kind::lower, {}, [&](std::size_t i) { return lower[i]; }, [](std::size_t) { return Vector{-pi, 0, 0}; });
    add(Kind::upper, {}, [&](std::size_t i) { return upper[i]; }, [](std::size_t) { return Vector{pi, 0, 0}; });
    for (std::size_t k = 0; k < sampled; ++k) {
        add(
            Kind::sampled, k, [&](std::size_t i) { return lower[i] + uniform(k, i) * (upper[i] - lower[i]); },
            [&](std::size_t i) {
                return uniform_rotation_vector(uniform(k, i), uniform(k, i + 1), uniform(k, i + 2));
            });
    }
    return module;
}

#endif
