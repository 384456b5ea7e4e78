// Collisions by FCL, as a planner uses it: convex hulls, a tree of bounding boxes over the obstacles, the pairs of
// links that urdd does not skip, each behind its own bounding boxes, and an end at the first collision.

#ifndef PLANNING_FCL_CHECKER_HPP
#define PLANNING_FCL_CHECKER_HPP

#include "scene.hpp"

#include <fcl/fcl.h>
#include <sstream>

class FclChecker {
public:
    FclChecker(const urdd::Robot &robot, const urdd::Proximity &proximity, const std::string &urdd, const Scene &scene)
        : robot_(robot), poses_(robot.num_links()), pairs_(proximity.pairs()) {
        const auto hulls = types::read_module<types::ConvexHullMeshesModule>(urdd).link_hulls;
        for (const std::optional<types::MeshFiles> &files : hulls) {
            links_.push_back(files ? object(hull(urdd + "/" + files->obj.value())) : nullptr);
        }
        for (const Box &box : scene.boxes) {
            const auto [x, y, z] = box.half_extents;
            place(std::make_shared<fcl::Boxd>(2 * x, 2 * y, 2 * z), pose_of(box.centre, box.rpy));
        }
        for (const Ball &ball : scene.balls) {
            place(std::make_shared<fcl::Sphered>(ball.radius), pose_of(ball.centre, {0, 0, 0}));
        }
        for (const Capsule &one : scene.capsules) {
            place(std::make_shared<fcl::Capsuled>(one.radius, 2 * one.half_length), pose_of(one.centre, one.rpy));
        }
        for (std::size_t index = 0; index < obstacles_.size(); ++index) {
            world_.registerObject(obstacles_[index].get());
            if (index > 0 || !scene.stands_on_first) {
                above_.registerObject(obstacles_[index].get());
            }
        }
        world_.setup();
        above_.setup();
    }

    bool in_collision(urdd::Span<const double> q) {
        robot_.link_poses({q.data(), 1, q.size()}, {poses_.data(), poses_.size()});
        for (std::size_t link = 0; link < links_.size(); ++link) {
            if (links_[link] == nullptr) {
                continue;
            }
            links_[link]->setTransform(transform(poses_[link]));
            links_[link]->computeAABB();
        }
        for (std::size_t link = 0; link < links_.size(); ++link) {
            bool found = false;
            if (links_[link] != nullptr) {
                (link == 0 ? above_ : world_).collide(links_[link].get(), &found, collide);
            }
            if (found) {
                return true;
            }
        }
        for (const urdd_pair &pair : pairs_) {
            const auto &a = links_[pair.links[0]], &b = links_[pair.links[1]];
            bool found = false;
            if (a->getAABB().overlap(b->getAABB()) && collide(a.get(), b.get(), &found)) {
                return true;
            }
        }
        return false;
    }

private:
    using Object = std::shared_ptr<fcl::CollisionObjectd>;

    static bool collide(fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *found) {
        const fcl::CollisionRequestd request;
        fcl::CollisionResultd result;
        return *static_cast<bool *>(found) = fcl::collide(a, b, request, result) > 0;
    }

    static fcl::Transform3d transform(const urdd::Pose &pose) {
        fcl::Transform3d found;
        found.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data());
        return found;
    }

    static Object object(const std::shared_ptr<fcl::CollisionGeometryd> &shape) {
        return std::make_shared<fcl::CollisionObjectd>(shape);
    }

    void place(const std::shared_ptr<fcl::CollisionGeometryd> &shape, const urdd::Pose &pose) {
        obstacles_.push_back(object(shape));
        obstacles_.back()->setTransform(transform(pose));
        obstacles_.back()->computeAABB();
    }

    static std::shared_ptr<fcl::Convexd> hull(const std::string &path) {
        std::ifstream file(path);
        auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
        auto faces = std::make_shared<std::vector<int>>();
        int count = 0;
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line);
            std::string kind;
            words >> kind;
            if (kind == "v") {
                fcl::Vector3d vertex;
                words >> vertex.x() >> vertex.y() >> vertex.z();
                vertices->push_back(vertex);
            } else if (kind == "f") {
                faces->push_back(3);
                for (std::string corner; words >> corner;) {
                    faces->push_back(std::stoi(corner) - 1);
                }
                ++count;
            }
        }
        return std::make_shared<fcl::Convexd>(vertices, count, faces, true);
    }

    const urdd::Robot &robot_;
    std::vector<urdd::Pose> poses_;
    std::vector<urdd_pair> pairs_;
    std::vector<Object> links_, obstacles_;
    fcl::DynamicAABBTreeCollisionManagerd world_, above_;
};

#endif
