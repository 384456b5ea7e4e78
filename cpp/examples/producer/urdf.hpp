// The modules that say what stands in the URDF: urdf_module (SPEC 6.1), dof_module (6.2) and bounds_module (6.5).

#ifndef PRODUCER_URDF_HPP
#define PRODUCER_URDF_HPP

#include "xml.hpp"

#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <unordered_map>
#include <urdd_types.hpp>

namespace types = urdd::types;
using types::JointType;

/// The numbers of an attribute; none where it is absent, or where one is not finite (SPEC 6.1.8).
inline std::optional<std::vector<double>> numbers(const Element *element, const std::string &key, std::size_t count) {
    static const std::regex number("[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?");
    static const std::regex not_finite("[+-]?(inf|infinity|nan)", std::regex::icase);
    const auto text = element == nullptr ? std::nullopt : element->get(key);
    if (!text) {
        return std::nullopt;
    }
    std::vector<double> values;
    bool finite = true;
    std::size_t at = 0;
    while ((at = text->find_first_not_of(" \t\r\n", at)) != std::string::npos) {
        const std::size_t end = std::min(text->find_first_of(" \t\r\n", at), text->size());
        const std::string word = text->substr(at, end - at);
        at = end;
        const bool is_number = word.size() < 400 && std::regex_match(word, number);
        demand(is_number || std::regex_match(word, not_finite), "<" + element->tag + " " + key + ">: not a number");
        values.push_back(is_number ? std::strtod(word.c_str(), nullptr) : HUGE_VAL);
        finite = finite && std::isfinite(values.back());
    }
    demand(values.size() == count,
           "<" + element->tag + " " + key + ">: " + std::to_string(count) + " number(s) wanted");
    return finite ? std::optional(values) : std::nullopt;
}

inline std::optional<double> number(const Element *element, const std::string &key) {
    const auto values = numbers(element, key, 1);
    return values ? std::optional(values->at(0)) : std::nullopt;
}

template <std::size_t count>
std::optional<std::array<double, count>> vector(const Element *element, const std::string &key) {
    const auto values = numbers(element, key, count);
    if (!values) {
        return std::nullopt;
    }
    std::array<double, count> array{};
    std::copy(values->begin(), values->end(), array.begin());
    return array;
}

/// What `read` makes of an element that is there.
template <class Value> std::optional<Value> of(const Element *element, void (*read)(const Element &, Value &)) {
    if (element == nullptr) {
        return std::nullopt;
    }
    Value value{};
    read(*element, value);
    return value;
}

template <class Value>
std::vector<Value> of(const std::vector<const Element *> &elements, void (*read)(const Element &, Value &)) {
    std::vector<Value> values(elements.size());
    for (std::size_t index = 0; index < elements.size(); ++index) {
        read(*elements[index], values[index]);
    }
    return values;
}

inline void read(const Element &element, types::Origin &origin) {
    origin.xyz = vector<3>(&element, "xyz");
    origin.rpy = vector<3>(&element, "rpy");
    origin.quat_xyzw = vector<4>(&element, "quat_xyzw");
}

inline double size(const Element &shape, const std::string &key) {
    shape.required(key);
    const auto value = number(&shape, key);
    demand(value.has_value(), "<" + shape.tag + " " + key + "> is not finite");
    return *value;
}

inline std::optional<types::Geometry> geometry(const Element *element) {
    if (element == nullptr) {
        return std::nullopt;
    }
    for (const auto &shape : element->children) {
        if (shape->tag == "mesh") {
            types::MeshGeometry mesh;
            mesh.mesh.filename = shape->required("filename");
            mesh.mesh.scale = vector<3>(shape.get(), "scale");
            return mesh;
        }
        if (shape->tag == "box") {
            shape->required("size");
            const auto size = vector<3>(shape.get(), "size");
            demand(size.has_value(), "<box size> is not finite");
            types::BoxGeometry box;
            box.box.size = *size;
            return box;
        }
        if (shape->tag == "cylinder") {
            types::CylinderGeometry cylinder;
            cylinder.cylinder.radius = size(*shape, "radius");
            cylinder.cylinder.length = size(*shape, "length");
            return cylinder;
        }
        if (shape->tag == "capsule") {
            types::CapsuleGeometry capsule;
            capsule.capsule.radius = size(*shape, "radius");
            capsule.capsule.length = size(*shape, "length");
            return capsule;
        }
        if (shape->tag == "sphere") {
            types::SphereGeometry sphere;
            sphere.sphere.radius = size(*shape, "radius");
            return sphere;
        }
    }
    return std::nullopt;
}

inline void read(const Element &element, types::Material &material) {
    material.name = element.get("name");
    if (const auto rgba = vector<4>(element.first("color"), "rgba")) {
        material.color.emplace().rgba = *rgba;
    }
    const Element *texture = element.first("texture");
    if (texture != nullptr && texture->get("filename")) {
        material.texture.emplace().filename = *texture->get("filename");
    }
}

inline void read(const Element &element, types::Collision &collision) {
    collision.name = element.get("name");
    collision.origin = of<types::Origin>(element.first("origin"), read);
    collision.geometry = geometry(element.first("geometry"));
}

inline void read(const Element &element, types::Visual &visual) {
    visual.name = element.get("name");
    visual.origin = of<types::Origin>(element.first("origin"), read);
    visual.geometry = geometry(element.first("geometry"));
    visual.material = of<types::Material>(element.first("material"), read);
}

inline void read(const Element &element, types::Inertial &inertial) {
    inertial.origin = of<types::Origin>(element.first("origin"), read);
    if (const auto mass = number(element.first("mass"), "value")) {
        inertial.mass.emplace().value = *mass;
    }
    if (const Element *inertia = element.first("inertia")) {
        auto &found = inertial.inertia.emplace();
        found.ixx = number(inertia, "ixx");
        found.ixy = number(inertia, "ixy");
        found.ixz = number(inertia, "ixz");
        found.iyy = number(inertia, "iyy");
        found.iyz = number(inertia, "iyz");
        found.izz = number(inertia, "izz");
    }
}

inline void read(const Element &element, types::Link &link) {
    link.name = element.required("name");
    link.inertial = of<types::Inertial>(element.first("inertial"), read);
    link.visual = of<types::Visual>(element.all("visual"), read);
    link.collision = of<types::Collision>(element.all("collision"), read);
    link.unknown_elements = element.others({"inertial", "visual", "collision"});
}

inline JointType joint_type(const std::string &text) {
    for (const JointType type : {JointType::revolute, JointType::continuous, JointType::prismatic, JointType::fixed,
                                 JointType::floating, JointType::planar, JointType::spherical}) {
        std::string word(types::word(type));
        word[0] = static_cast<char>(word[0] - 'A' + 'a');
        if (word == text) {
            return type;
        }
    }
    throw Refused("the joint type " + text);
}

inline void read(const Element &element, types::Joint &joint) {
    joint.name = element.required("name");
    joint.joint_type = joint_type(element.required("type"));
    joint.origin = of<types::Origin>(element.first("origin"), read);
    for (const char *end : {"parent", "child"}) {
        demand(element.first(end) != nullptr, "a joint without " + std::string(end));
    }
    joint.parent.link = element.first("parent")->required("link");
    joint.child.link = element.first("child")->required("link");
    if (const Element *axis = element.first("axis")) {
        joint.axis.emplace().xyz = vector<3>(axis, "xyz");
    }
    if (const Element *limit = element.first("limit")) {
        auto &found = joint.limit.emplace();
        found.lower = number(limit, "lower");
        found.upper = number(limit, "upper");
        found.effort = number(limit, "effort");
        found.velocity = number(limit, "velocity");
        found.acceleration = number(limit, "acceleration");
        found.deceleration = number(limit, "deceleration");
        found.jerk = number(limit, "jerk");
    }
    if (const Element *dynamics = element.first("dynamics")) {
        auto &found = joint.dynamics.emplace();
        found.damping = number(dynamics, "damping");
        found.friction = number(dynamics, "friction");
    }
    if (const Element *mimic = element.first("mimic")) {
        auto &found = joint.mimic.emplace();
        found.joint = mimic->required("joint");
        found.multiplier = number(mimic, "multiplier");
        found.offset = number(mimic, "offset");
    }
    if (const Element *safety = element.first("safety_controller")) {
        auto &found = joint.safety_controller.emplace();
        found.soft_lower_limit = number(safety, "soft_lower_limit");
        found.soft_upper_limit = number(safety, "soft_upper_limit");
        found.k_position = number(safety, "k_position");
        found.k_velocity = number(safety, "k_velocity");
    }
    if (const Element *calibration = element.first("calibration")) {
        auto &found = joint.calibration.emplace();
        found.rising = number(calibration, "rising");
        found.falling = number(calibration, "falling");
    }
    joint.unknown_elements = element.others(
        {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller", "calibration"});
}

/// Whether `quat_xyzw` counts: from URDF 1.1 on (SPEC 6.1.9).
inline bool has_quaternions(const std::optional<std::string> &version) {
    std::smatch parts;
    static const std::regex form("[ \t\r\n]*([0-9]{1,9})\\.([0-9]{1,9})[ \t\r\n]*");
    if (!version || !std::regex_match(*version, parts, form)) {
        return false;
    }
    return std::make_pair(std::stol(parts[1]), std::stol(parts[2])) >= std::make_pair(1L, 1L);
}

inline void check_rotation(const Element *origin) {
    demand(origin == nullptr || !origin->get("rpy") || !origin->get("quat_xyzw"), "an origin with two rotations");
}

inline types::UrdfModule urdf_module(const Element &robot) {
    demand(robot.tag == "robot", "the root element is " + robot.tag);
    if (has_quaternions(robot.get("version"))) {
        for (const Element *link : robot.all("link")) {
            for (const char *part : {"inertial", "visual", "collision"}) {
                for (const Element *element : link->all(part)) {
                    check_rotation(element->first("origin"));
                }
            }
        }
        for (const Element *joint : robot.all("joint")) {
            check_rotation(joint->first("origin"));
        }
    }
    types::UrdfModule urdf;
    urdf.name = robot.required("name");
    urdf.version = robot.get("version");
    urdf.links = of<types::Link>(robot.all("link"), read);
    urdf.joints = of<types::Joint>(robot.all("joint"), read);
    urdf.materials = of<types::Material>(robot.all("material"), read);
    urdf.unknown_elements = robot.others({"link", "joint", "material"});
    return urdf;
}

/// What follows the joint's name in those of its DOFs (SPEC 6.2.5).
inline std::vector<std::string> suffixes(JointType type) {
    switch (type) {
    case JointType::fixed: return {};
    case JointType::planar: return {"/trans_x", "/trans_y", "/rot"};
    case JointType::floating: return {"/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z"};
    case JointType::spherical: return {"/rot_x", "/rot_y", "/rot_z"};
    default: return {""};
    }
}

inline bool is_mimic(const types::Joint &joint) { return joint.mimic && joint.joint_type != JointType::fixed; }

inline types::DofModule dof_module(const types::UrdfModule &urdf) {
    types::DofModule module;
    std::unordered_map<std::string, std::size_t> by_name;
    for (std::size_t index = 0; index < urdf.joints.size(); ++index) {
        const types::Joint &joint = urdf.joints[index];
        demand(by_name.emplace(joint.name, index).second, "two joints of the name " + joint.name);
        auto &own = module.joint_idx_to_dof_idxs_mapping.emplace_back();
        for (const std::string &suffix : is_mimic(joint) ? std::vector<std::string>() : suffixes(joint.joint_type)) {
            const bool is_length = joint.joint_type == JointType::prismatic || suffix.rfind("/trans", 0) == 0;
            own.push_back(module.dofs.size());
            module.dof_idx_to_joint_idx_mapping.push_back(index);
            types::Dof &dof = module.dofs.emplace_back();
            dof.name = joint.name + suffix;
            dof.joint_idx = index;
            dof.joint_name = joint.name;
            dof.quantity = is_length ? types::Quantity::length : types::Quantity::angle;
        }
    }
    module.num_dofs = module.dofs.size();
    for (const types::Joint &joint : urdf.joints) {
        auto &resolved = module.joint_idx_to_mimic_mapping.emplace_back();
        if (!is_mimic(joint)) {
            continue;
        }
        // Along the chain of mimic joints, then back: a product and a sum from its end (SPEC 5.10).
        std::vector<const types::Joint *> chain{&joint};
        while (is_mimic(*chain.back())) {
            const types::Joint &last = *chain.back();
            demand(suffixes(last.joint_type).size() == 1, last.name + " follows another, and has several DOFs");
            const auto next = by_name.find(last.mimic->joint);
            demand(next != by_name.end(), last.name + " follows a joint that is not there");
            demand(chain.size() <= urdf.joints.size(), "mimic joints go in a circle at " + joint.name);
            chain.push_back(&urdf.joints[next->second]);
        }
        demand(suffixes(chain.back()->joint_type).size() < 2, joint.name + " follows several DOFs");
        const auto &driver = module.joint_idx_to_dof_idxs_mapping[by_name.at(chain.back()->name)];
        double multiplier = 1, offset = 0;
        for (std::size_t index = chain.size() - 1; index-- > 0;) {
            const types::Mimic &mimic = *chain[index]->mimic;
            const double own = mimic.multiplier.value_or(1.0);
            offset = own * offset + mimic.offset.value_or(0.0);
            multiplier = own * multiplier;
        }
        demand(std::isfinite(multiplier) && std::isfinite(offset), "the mimic of " + joint.name + " is not finite");
        resolved.emplace();
        resolved->dof_idx = driver.empty() ? std::nullopt : std::optional(driver[0]);
        resolved->multiplier = multiplier;
        resolved->offset = offset;
    }
    return module;
}

inline types::BoundsModule bounds_module(const types::UrdfModule &urdf, const types::DofModule &dof) {
    types::BoundsModule module;
    for (const types::Dof &entry : dof.dofs) {
        const types::Joint &joint = urdf.joints[entry.joint_idx];
        const types::Limit limit = joint.limit.value_or(types::Limit{});
        const double free = entry.quantity == types::Quantity::angle ? std::acos(-1.0) : 1.0;
        const bool can = joint.joint_type == JointType::revolute || joint.joint_type == JointType::prismatic;
        const bool limited = can && (limit.lower || limit.upper);
        const bool single = suffixes(joint.joint_type).size() == 1;
        const double lower = limited ? limit.lower.value_or(0.0) : -free;
        const double upper = limited ? limit.upper.value_or(0.0) : free;
        module.bounds.push_back({lower, upper});
        module.dof_lower_bounds.push_back(lower);
        module.dof_upper_bounds.push_back(upper);
        module.dof_limited.push_back(limited);
        module.dof_velocity_limits.push_back(single ? limit.velocity : std::nullopt);
        module.dof_effort_limits.push_back(single ? limit.effort : std::nullopt);
    }
    return module;
}

#endif
