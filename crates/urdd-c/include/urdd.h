// The C interface of urdd: a robot to ask about itself, from a URDD. docs/cpp.md has examples; urdd.hpp is the same for
// C++. Written by cbindgen from crates/urdd-c; do not edit.
//
// Status. Every function that can fail returns a `urdd_status`; `URDD_STATUS_OK` is 0. After another one,
// `urdd_error_message` has the text, which names what is wrong and what to do. "Errors" below names statuses without
// their prefix. Those of every function are not repeated: POINTER, HANDLE, UTF8, MEMORY, INTERNAL; LENGTH for an array of
// another length than the function says; VALUE for NaN or infinity in a configuration. After an error, outputs are zeros or
// incomplete. Nothing unwinds out of a function, and no function calls back.
//
// Ownership. A function whose last argument is a pointer to a handle makes one; after an error it is null. The caller
// frees it with the `..._free` of its type, once. Handles are independent: they can be freed in any order. Arrays belong
// to the caller, and nothing keeps them after the call. An array that is written overlaps no other argument. A `urdd_text`
// that a function writes lives as long as its handle.
//
// Files. A robot is the one that was there when it was opened. A call that first needs a module reads it, and it is kept.
// If the folder changed on disk before, the status is UNUSABLE, never an answer of two robots: open it again.
//
// Threads. A handle never changes after it is made: any number of threads can use it at once. The functions that end with
// `_move_obstacles` alone change it: no other thread uses that handle meanwhile. A handle must not be freed while another
// thread uses it. Each thread has its own last error, and its own memory for queries on one configuration. Batches,
// and calls that read a URDD, run on one pool of threads that the first call starts: as many as processors, or as the
// environment variable RAYON_NUM_THREADS says. Where none can be started, they run on the calling thread. Results do not
// depend on their number.
//
// Fork. A child can call every function, with the handles that it has from its parent: it has no thread of the pool, and
// runs batches on the calling thread. Fork while no other thread is in a call: what that call was reading is never ready
// in the child. At `exit` and in destructors, functions answer too; the last error's text may be gone.
//
// Memory. Where there is not enough for what the caller sends or asks for (rows, targets, points, obstacles, bytes, texts),
// the status is MEMORY. Another allocation that fails, such as for a module that is read, ends the process.
//
// Numbers. Metres, radians, kilograms. Poses are in the root link's frame unless stated otherwise. A configuration has one
// value for each DOF, in the order of `urdd_robot_dof_name`; links are in the order of `urdd_robot_link_name`. Arrays are
// row-major. Functions on configurations take rows: one configuration is one row. Null is allowed for an array without
// values.
//
// Contract. A pointer to a handle is null or an open handle, which stays open during the call. A text is null or ends with
// a zero byte. An array is null or has as many values, or room for as many, as the function says; an output is null or has
// room for one value. Null is an error, and not undefined behaviour, unless the function says what it stands for.
//
// Debug builds of the library check that a handle is open and of its type. Release builds do not: using a freed handle, or
// an array that is shorter than stated, is undefined behaviour, as everywhere in C.


#ifndef URDD_H
#define URDD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The ABI number of this header. A library with another one must not be used with it: `urdd_abi_version` gives that of
// the library.
#define URDD_ABI_VERSION 1

// What a function returns. After any other than `URDD_STATUS_OK`, `urdd_error_message` says what is wrong.
typedef enum urdd_status {
    // The call succeeded.
    URDD_STATUS_OK = 0,
    // A pointer is null or not aligned, or an array that is written overlaps another one.
    URDD_STATUS_POINTER = 1,
    // A handle is not open, or of another type. Only debug builds of the library check this.
    URDD_STATUS_HANDLE = 2,
    // An array does not have the expected length, or it is longer than any memory.
    URDD_STATUS_LENGTH = 3,
    // A number is NaN or infinite, or a value is not allowed.
    URDD_STATUS_VALUE = 4,
    // An index is out of range.
    URDD_STATUS_OUT_OF_RANGE = 5,
    // A text is not UTF-8.
    URDD_STATUS_UTF8 = 6,
    // A name is unknown: of a link, joint, DOF, configuration or kind of shapes.
    URDD_STATUS_UNKNOWN_NAME = 7,
    // A folder, archive or file cannot be opened or read.
    URDD_STATUS_OPEN = 8,
    // The URDD lacks a module that the call needs.
    URDD_STATUS_MISSING_MODULE = 9,
    // A module or mesh of the URDD is unusable.
    URDD_STATUS_UNUSABLE = 10,
    // There is not enough memory for the results.
    URDD_STATUS_MEMORY = 11,
    // The library is at fault: please report it.
    URDD_STATUS_INTERNAL = 12,
} urdd_status;

// Whether a target is reached; if not, why.
typedef enum urdd_verdict {
    // None within the bounds was found; why was not searched for.
    URDD_VERDICT_UNKNOWN = 0,
    // It is reached within the tolerances.
    URDD_VERDICT_REACHED = 1,
    // Every configuration that was found to reach it was refused by `free_of` or `free_of_world`.
    URDD_VERDICT_REFUSED = 2,
    // None within the bounds was found, but one beyond them.
    URDD_VERDICT_LIMITS = 3,
    // None was found, within the bounds or beyond them.
    URDD_VERDICT_OUT_OF_REACH = 4,
    // None was found that is closed, but one within the bounds with open loops.
    URDD_VERDICT_LOOPS = 5,
} urdd_verdict;

// Why a motion cannot go on.
typedef enum urdd_obstruction {
    // It can.
    URDD_OBSTRUCTION_NONE = 0,
    // A pair is at most the margin apart, or is not proved farther apart.
    URDD_OBSTRUCTION_CONTACT = 1,
    // No configuration was found there in which the loops of the robot are closed, within its bounds.
    URDD_OBSTRUCTION_OPEN = 2,
    // The DOFs that follow would have to jump, or arrive elsewhere than at the end: it is on another branch of the closed
    // configurations.
    URDD_OBSTRUCTION_BRANCH = 3,
} urdd_obstruction;

// What covering spheres say.
typedef enum urdd_covering_answer {
    // Spheres touch; the shapes may.
    URDD_COVERING_ANSWER_MAYBE = 0,
    // Certainly no contact.
    URDD_COVERING_ANSWER_FREE = 1,
} urdd_covering_answer;

// What approximating spheres say.
typedef enum urdd_approximate_answer {
    // Spheres touch; the shapes may be apart.
    URDD_APPROXIMATE_ANSWER_CONTACT = 0,
    // No spheres touch; parts of shapes outside of them may.
    URDD_APPROXIMATE_ANSWER_FREE = 1,
} urdd_approximate_answer;

// Spheres that are near the shapes of a robot: nothing is certain.
typedef struct urdd_approximating_checker urdd_approximating_checker;

// The learned self-collision model of a URDD (SPEC 8.8): an estimate of the clearance between links.
typedef struct urdd_collision_model urdd_collision_model;

// Spheres that contain the shapes of a robot: where none touch, the robot is certainly free.
typedef struct urdd_covering_checker urdd_covering_checker;

// A body that a robot must not touch, in the root link's frame.
typedef struct urdd_obstacle urdd_obstacle;

// The shapes of one kind of a robot, prepared for distances.
typedef struct urdd_proximity urdd_proximity;

// What validation found.
typedef struct urdd_report urdd_report;

// A robot, as its URDD describes it.
typedef struct urdd_robot urdd_robot;

// The skips between the shapes of one kind.
typedef struct urdd_skips urdd_skips;

// The shapes of a robot and obstacles, prepared for distances.
typedef struct urdd_world_proximity urdd_world_proximity;

// A text in UTF-8: `length` bytes at `data`, and a zero byte after them. A name can contain zero bytes itself.
typedef struct urdd_text {
    // Its first byte; never null.
    const char *data;
    // Number of bytes, without the zero byte.
    size_t length;
} urdd_text;

// Two links.
typedef struct urdd_link_pair {
    // Their indices.
    size_t links[2];
} urdd_link_pair;

// Tolerances and limits of inverse kinematics. Begin with `urdd_inverse_settings_default`: settings full of zeros are
// refused, as they allow no iteration.
typedef struct urdd_inverse_settings {
    // Position tolerance, metres; 0 or more.
    double position_tolerance;
    // Rotation tolerance, radians; 0 or more.
    double rotation_tolerance;
    // Maximum number of iterations per descent; at least 1.
    size_t iterations;
    // Maximum number of descents from random configurations after the first one.
    size_t restarts;
    // Seed of the random configurations. The search is deterministic.
    uint64_t seed;
    // Bounds in place of those of bounds_module, rad or m: a lower and an upper value for each DOF, limited or not; or
    // null.
    const double *bounds;
    // Number of values at `bounds`: dofs x 2; 0 for null.
    size_t bounds_length;
    // Indices of DOFs that keep the value that they have in the start; or null.
    const size_t *locked;
    // Number of indices at `locked`.
    size_t locked_length;
    // A configuration that the solution should be near, rad or m; or null. Restarts go on until several in a row bring
    // no nearer solution, and the nearest counts.
    const double *posture;
    // Number of values at `posture`: dofs; 0 for null.
    size_t posture_length;
    // Shapes that must not touch one another in a solution, which is searched until one is free; or null.
    const struct urdd_proximity *free_of;
    // A robot among obstacles that it must not touch in a solution; or null.
    const struct urdd_world_proximity *free_of_world;
    // The distance that a solution keeps from the obstacles of `free_of_world`, metres; 0 or more.
    double margin;
    // Whether to find out why a target is not reached, which takes as long as the search.
    bool explain;
    // Whether the kinematic loops of the robot may be open in a solution. False in the settings of
    // `urdd_inverse_settings_default`; without meaning for a tree.
    bool open_loops;
} urdd_inverse_settings;

// A target of inverse kinematics, in the root link's frame.
typedef struct urdd_target {
    // The index of the link.
    size_t link;
    // The pose: a homogeneous 4 x 4 matrix in row-major order, metres. Its rotation is that of the link's frame, its
    // translation where `point` should be.
    double pose[16];
    // A point of the link, such as a tool tip, in the link's frame, metres.
    double point[3];
    // True if only the position counts: the link's rotation is free.
    bool is_position;
    // Weights of the translation along, and of the rotation about, the x, y and z axes of `pose`, 0 or more: 0 leaves
    // one free, as (0, 0, 0, 1, 1, 1) for a rotation alone. Six zeros stand for six ones.
    double weights[6];
} urdd_target;

// How near a configuration comes to its target.
typedef struct urdd_inverse_solution {
    // Distance of the point from the target, metres.
    double position_error;
    // Angle between the link's rotation and the target, radians; 0 for a position.
    double rotation_error;
    // Number of descents from random configurations.
    size_t restarts;
    // Number of iterations of all descents.
    size_t iterations;
    // True if the target is reached within the tolerances.
    bool is_reached;
    // Whether it is, or why not.
    enum urdd_verdict verdict;
} urdd_inverse_solution;

// Where a motion is blocked first, as parts of it from 0 to 1.
typedef struct urdd_motion {
    // The last part that is known to be free; 0 if the start is not, NaN if the motion is free.
    double free;
    // The first part that is not; NaN if the motion is free.
    double blocked;
    // Why it is not.
    enum urdd_obstruction obstruction;
} urdd_motion;

// Two shapes that are checked against each other.
typedef struct urdd_pair {
    // The indices of their links; for an attached object, of the link that carries it.
    size_t links[2];
    // The indices of the two bodies: of the links, or, from the number of links on, of the attached objects in the order
    // in which they were attached. `urdd_proximity_body_name` has their names.
    size_t bodies[2];
    // The indices of the pieces of these links; 0 for hulls and their bounding volumes.
    size_t pieces[2];
} urdd_pair;

// Two shapes, their distance, and their closest points.
typedef struct urdd_pair_distance {
    // The two shapes.
    struct urdd_pair pair;
    // Metres; 0 if they touch or overlap.
    double distance;
    // The distance divided by the pair's mean distance in link_shapes_distance_statistics_module; NaN without.
    double relative;
    // The closest points, of the first shape and of the second, in the root link's frame, metres. If the shapes
    // overlap, both are the same point, which is in both.
    double points[2][3];
} urdd_pair_distance;

// A shape of the robot and an obstacle, their distance, and their closest points.
typedef struct urdd_obstacle_distance {
    // The index of the link; for an attached object, of the link that carries it.
    size_t link;
    // The index of the body: of the link, or, from the number of links on, of the attached object.
    size_t body;
    // The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    size_t piece;
    // The index of the obstacle.
    size_t obstacle;
    // Metres; 0 if they touch or overlap.
    double distance;
    // The closest points, of the link's shape and of the obstacle, in the root link's frame, metres. If the two
    // overlap, both are the same point, which is in both.
    double points[2][3];
} urdd_obstacle_distance;

// Two shapes that touch or overlap.
typedef struct urdd_overlap {
    // The two shapes. Their distance is 0; the points are those that touch once the second shape has moved, before it
    // moves.
    struct urdd_pair_distance pair;
    // The length of the least translation that separates the two, metres; 0 if they touch.
    double depth;
    // The unit vector, in the root link's frame, along which the second shape would move.
    double direction[3];
} urdd_overlap;

// A shape of the robot and an obstacle that touch or overlap.
typedef struct urdd_obstacle_overlap {
    // The two. Their distance is 0; the points are those that touch once the obstacle has moved, before it moves.
    struct urdd_obstacle_distance pair;
    // The length of the least translation that separates the two, metres; 0 if they touch.
    double depth;
    // The unit vector, in the root link's frame, along which the obstacle would move.
    double direction[3];
} urdd_obstacle_overlap;

// A shape: the index of its link, and of the link's piece; 0 for hulls and their bounding volumes.
typedef struct urdd_shape_place {
    // The index of the link.
    size_t link;
    // The index of the piece.
    size_t piece;
} urdd_shape_place;

// A sphere of a link, on a level.
typedef struct urdd_link_sphere {
    // The level, from 0, the coarsest, on. Each finer level is inside the coarser one, and the finest decides.
    size_t level;
    // The index of the link.
    size_t link;
    // In the link's frame, metres.
    double centre[3];
    // Metres.
    double radius;
} urdd_link_sphere;

// A shape of the robot and an obstacle that are checked against each other.
typedef struct urdd_obstacle_pair {
    // The index of the link; for an attached object, of the link that carries it.
    size_t link;
    // The index of the body: of the link, or, from the number of links on, of the attached object.
    size_t body;
    // The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    size_t piece;
    // The index of the obstacle.
    size_t obstacle;
} urdd_obstacle_pair;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The ABI number of the library.
uint32_t urdd_abi_version(void);

// The version of the library, such as "1.4.0". It lives as long as the library.
struct urdd_text urdd_version(void);

// Makes shapes in which a link carries an object, whose pose is that in the link's frame. The object is checked against
// all links that move against it, but those that it ignores: the ones that may touch it. The shapes at `handle` stay as they are.
//
// In answers, an object has the index of its link in `links`, and one of its own in `bodies`; `pieces` counts its parts.
//
// Errors: `OUT_OF_RANGE` for a link; `UNKNOWN_NAME` if the object ignores an unknown link; `VALUE` if a link or an
// attached object has its name.
enum urdd_status urdd_proximity_attach(const struct urdd_proximity *handle,
                                       size_t link,
                                       const struct urdd_obstacle *object,
                                       struct urdd_proximity **out);

// Makes shapes without some pairs of bodies, which are links or attached objects: MoveIt's allowed collision matrix at run
// time, such as for two links that are always nearer than a margin. `names` has 2 x `count` names: of the first pair,
// of the second pair and so on. Obstacles are still checked; the shapes at `handle` stay as they are.
//
// Errors: `UNKNOWN_NAME`, whose message has the nearest name.
enum urdd_status urdd_proximity_without(const struct urdd_proximity *handle,
                                        const char *const *names,
                                        size_t count,
                                        struct urdd_proximity **out);

// As `urdd_proximity_without`, for all that belongs to `count` bodies, among obstacles too. The indices of the other
// bodies stay.
enum urdd_status urdd_proximity_without_bodies(const struct urdd_proximity *handle,
                                               const char *const *names,
                                               size_t count,
                                               struct urdd_proximity **out);

// Writes the number of bodies: of links, and of attached objects, in the order in which they were attached.
enum urdd_status urdd_proximity_num_bodies(const struct urdd_proximity *handle, size_t *out);

// Writes the index of a body, as in `bodies` of `urdd_pair`.
//
// Errors: `UNKNOWN_NAME`, whose message has the nearest name.
enum urdd_status urdd_proximity_body(const struct urdd_proximity *handle, const char *name, size_t *out);

// Writes the name of a body.
//
// Errors: `OUT_OF_RANGE`.
enum urdd_status urdd_proximity_body_name(const struct urdd_proximity *handle, size_t body, struct urdd_text *out);

// Reads the learned self-collision model. It filters out configurations far from contact, before an exact check of the
// rest. It is an estimate, not a guarantee: `urdd_collision_model_evaluation` has its measured error rates.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: self_collision_model_module, chain_module or dof_module.
enum urdd_status urdd_robot_collision_model(const struct urdd_robot *handle, struct urdd_collision_model **out);

// Frees a model. Null is ignored.
enum urdd_status urdd_collision_model_free(struct urdd_collision_model *model);

// Writes the error rates that the module states, measured on configurations that were not used to make the model: the
// JSON of `evaluation` in self_collision_model_module. It lives as long as the model.
enum urdd_status urdd_collision_model_evaluation(const struct urdd_collision_model *handle, struct urdd_text *out);

// Writes the number of link pairs and of DOFs. Each of the two can be null.
enum urdd_status urdd_collision_model_sizes(const struct urdd_collision_model *handle, size_t *pairs, size_t *dofs);

// Writes the link pairs, in the order of `urdd_collision_model_clearances`.
enum urdd_status urdd_collision_model_pairs(const struct urdd_collision_model *handle,
                                            struct urdd_link_pair *pairs,
                                            size_t length);

// Writes the estimated clearance of each link pair for each configuration, metres. 0 or less: the pair may be in
// contact.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `clearances` has room for `length` values: rows x pairs.
enum urdd_status urdd_collision_model_clearances(const struct urdd_collision_model *handle,
                                                 const double *configurations,
                                                 size_t rows,
                                                 size_t dofs,
                                                 double *clearances,
                                                 size_t length);

// Writes whether any pair may be in contact, for each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values.
enum urdd_status urdd_collision_model_may_collide(const struct urdd_collision_model *handle,
                                                  const double *configurations,
                                                  size_t rows,
                                                  size_t dofs,
                                                  bool *colliding);

// The message of the last call of this thread that failed; empty before. It lives until the next call of this thread
// that fails, or until the thread ends: at `exit`, and in destructors of the thread's own variables, it may be gone, and
// a text says so.
struct urdd_text urdd_error_message(void);

// Writes the default settings: tolerances of 1e-6, 100 iterations, 100 restarts, seed 0, no bounds, nothing
// locked, no posture, no shapes, no obstacles, no margin, no explanation.
enum urdd_status urdd_inverse_settings_default(struct urdd_inverse_settings *out);

// Searches, for each target, a configuration within the bounds that reaches it: by damped least squares from its
// start, then from random configurations. Checks for collisions where `free_of` or `free_of_world` is set.
//
// Without `bounds`, a DOF that is not limited may also move as far from its start as its bounds are from 0: an angle
// half a turn either way, so that a joint that follows a path does not jump by a turn. Of values a whole turn apart
// that are within the bounds, the nearest to the posture, or to the start, is written.
//
// There are `count` targets. `starts` has `starts_rows` rows of `dofs` values, rad or m: one for all targets or one
// for each. `settings` may be null. `configurations` has room for count x dofs values, `solutions` for `count`. Where
// a target is not reached, the nearest configuration is written, and its solution says so.
//
// Errors: `OUT_OF_RANGE` for a link or a locked DOF; `LENGTH`, also for a posture or bounds without their length;
// `VALUE` for NaN or infinity, a matrix that is not a rotation and a translation, a tolerance, weight or margin below
// 0, weights that leave nothing to reach, crossed bounds, or 0 iterations; `POINTER` also if an output overlaps
// anything else that is given; `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module or bounds_module.
enum urdd_status urdd_robot_inverse_kinematics(const struct urdd_robot *handle,
                                               const struct urdd_target *targets,
                                               size_t count,
                                               const double *starts,
                                               size_t starts_rows,
                                               size_t dofs,
                                               const struct urdd_inverse_settings *settings,
                                               double *configurations,
                                               struct urdd_inverse_solution *solutions);

// Writes the pose of each link in the root link's frame for each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m. `poses` has room for `length` values: rows x links x 4
// x 4, a homogeneous matrix in row-major order for each link, in metres. Values beyond the bounds are allowed. One row
// is computed on this thread, without an allocation.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
enum urdd_status urdd_robot_link_poses(const struct urdd_robot *handle,
                                       const double *configurations,
                                       size_t rows,
                                       size_t dofs,
                                       double *poses,
                                       size_t length);

// Writes the geometric Jacobian of a link for each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m. `point` is a point of the link in the link's frame, 3
// values in metres; null is the origin of its frame. `jacobians` has room for `length` values: rows x dofs x 6, the
// six rows of each column together (column-major). The first three are the linear velocity of the point, the others the
// angular velocity, both in the root link's frame. A mimic joint counts for the DOF that it follows. One row is
// computed on this thread, without an allocation.
//
// Errors: `OUT_OF_RANGE` for the link; `MISSING_MODULE`, `UNUSABLE`:
// chain_module or dof_module.
enum urdd_status urdd_robot_jacobians(const struct urdd_robot *handle,
                                      const double *configurations,
                                      size_t rows,
                                      size_t dofs,
                                      size_t link,
                                      const double *point,
                                      double *jacobians,
                                      size_t length);

// Writes the largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none. `dofs`
// values.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: bounds_module.
enum urdd_status urdd_robot_velocity_limits(const struct urdd_robot *handle, double *limits, size_t dofs);

// As `urdd_robot_velocity_limits`, for the largest effort of each DOF, N m or N.
enum urdd_status urdd_robot_effort_limits(const struct urdd_robot *handle, double *limits, size_t dofs);

// Writes the mass of each link, kg, 0 where the source states none, and its centre of mass in the link's frame, metres:
// links x 4 values.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: urdf_module.
enum urdd_status urdd_robot_link_masses(const struct urdd_robot *handle, double *masses, size_t length);

// Writes the centre of mass of the robot in the root link's frame for each configuration, metres; NaN for a robot whose
// source states no mass.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `centres` has room for rows x 3 values.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: urdf_module, chain_module or dof_module.
enum urdd_status urdd_robot_centre_of_mass(const struct urdd_robot *handle,
                                           const double *configurations,
                                           size_t rows,
                                           size_t dofs,
                                           double *centres);

// Writes the torque (N m) or force (N) of each DOF that holds the robot still against gravity, for each configuration. It
// is what the motors must give, positive where the DOF must push toward larger values. A mimic joint counts for the DOF
// that it follows; of a rotation vector, the values are derivatives with respect to its components.
//
// `configurations` has `rows` rows of `dofs` values, rad or m. `gravity` is 3 values in the root link's frame, m/s^2; null
// is (0, 0, -9.81). `payload` is a mass in kg that `link` carries at `point`, 3 values in the link's frame in metres; null
// is the origin of its frame. With a payload of 0, neither `link` nor `point` is read. `torques` has room for `length`
// values: rows x dofs. One row is computed on this thread, without an allocation.
//
// Errors: `VALUE` for a payload below 0, and for numbers that are not finite; `OUT_OF_RANGE` for the link;
// `MISSING_MODULE`, `UNUSABLE`: urdf_module, chain_module or dof_module.
enum urdd_status urdd_robot_gravity_torques(const struct urdd_robot *handle,
                                            const double *configurations,
                                            size_t rows,
                                            size_t dofs,
                                            const double *gravity,
                                            double payload,
                                            size_t link,
                                            const double *point,
                                            double *torques,
                                            size_t length);

// Writes the number of loops, of couplings between DOFs, of equations of both together, and of DOFs that move freely. Each
// of the four can be null. A robot without loops_module is a tree: it has no equations, every configuration is closed, and
// all DOFs move freely.
//
// Errors, as of all functions on loops: `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module, loops_module; for a robot
// with loops also bounds_module and urdf_module.
enum urdd_status urdd_robot_loop_sizes(const struct urdd_robot *handle,
                                       size_t *loops,
                                       size_t *couplings,
                                       size_t *equations,
                                       size_t *independent);

// Writes the name of a loop. It lives as long as the robot.
//
// Errors: also `OUT_OF_RANGE`.
enum urdd_status urdd_robot_loop_name(const struct urdd_robot *handle, size_t index, struct urdd_text *out);

// As `urdd_robot_loop_name`, for a coupling.
enum urdd_status urdd_robot_coupling_name(const struct urdd_robot *handle, size_t index, struct urdd_text *out);

// Writes a configuration in which all loops are closed, to begin with: that of loops_module; for a tree, the default one.
// `dofs` values, rad or m.
enum urdd_status urdd_robot_reference_configuration(const struct urdd_robot *handle,
                                                    double *configuration,
                                                    size_t dofs);

// Writes how far each configuration is from closed.
//
// `configurations` has `rows` rows of `dofs` values, rad or m. `gaps` has room for `gaps_length` values, rows x loops x 2:
// the position gap of each loop in metres, then its rotation gap in radians. `sums` has room for `sums_length` values,
// rows x couplings: the sum of each coupling, which is 0 where it holds. `closed` has room for `rows` values: whether all
// loops are closed and all couplings hold, within their tolerances.
enum urdd_status urdd_robot_loop_errors(const struct urdd_robot *handle,
                                        const double *configurations,
                                        size_t rows,
                                        size_t dofs,
                                        double *gaps,
                                        size_t gaps_length,
                                        double *sums,
                                        size_t sums_length,
                                        bool *closed);

// Writes the closed configuration near each of some configurations, within the bounds.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `found` has room for rows x dofs values, `closed` for
// `rows`. Start near what is wanted, such as from the last configuration of a motion: the result is on the branch of
// closed configurations that is near. Where none is found, `closed` is false, and `found` has the smallest gaps: as a
// rule, the loops cannot close with what is held and bounded. `held` has the indices of `held_length` DOFs that keep their
// value; or null. `bounds` has `bounds_length` values, dofs x 2, a lower and an upper one for each DOF, which may be
// infinite; or null, with 0, for those of bounds_module: a DOF that is not limited has none. Values out of bounds are
// first moved to the nearest bound. One row is computed on this thread, without an allocation.
//
// Errors: also `OUT_OF_RANGE` for a held DOF; `VALUE` for crossed bounds.
enum urdd_status urdd_robot_close(const struct urdd_robot *handle,
                                  const double *configurations,
                                  size_t rows,
                                  size_t dofs,
                                  const size_t *held,
                                  size_t held_length,
                                  const double *bounds,
                                  size_t bounds_length,
                                  double *found,
                                  bool *closed);

// Writes the indices of the DOFs that move freely, ascending, as loops_module states them; the others follow from them
// near its reference configuration. `out` has room for `length` indices: as many as `urdd_robot_loop_sizes` says.
enum urdd_status urdd_robot_independent_dofs(const struct urdd_robot *handle, size_t *out, size_t length);

// Writes for each DOF whether it moves freely in a closed configuration: as `urdd_robot_independent_dofs`, as far as the
// others follow from these there. `configuration` has `dofs` values, rad or m; `free` has room for as many.
enum urdd_status urdd_robot_free_dofs(const struct urdd_robot *handle,
                                      const double *configuration,
                                      size_t dofs,
                                      bool *free);

// Writes the left-hand side of each equation, which is 0 where it holds: for each loop those of its kind, then the sum of
// each coupling. With the pose of frame B in frame A, of position p and rotation R, a loop has the components of p that it
// holds, m; then the rotation vector of R if it holds the rotation, the x and y components of R ez if it holds the
// direction of z, or the z component of R ez if it holds the right angle.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `residuals` has room for `length` values: rows x equations.
// One row is computed on this thread, without an allocation.
enum urdd_status urdd_robot_loop_residuals(const struct urdd_robot *handle,
                                           const double *configurations,
                                           size_t rows,
                                           size_t dofs,
                                           double *residuals,
                                           size_t length);

// Writes the derivatives of the equations of `urdd_robot_loop_residuals` by each DOF. Velocities keep the loops closed
// where this matrix times them is 0. The rows of a rotation that a loop holds are the angular velocity of frame B relative
// to frame A, in the axes of frame A. Rows that say the same as others are normal.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `jacobians` has room for `length` values: rows x dofs x
// equations, the values of each column together (column-major). One row is computed on this thread, without an allocation.
enum urdd_status urdd_robot_loop_jacobians(const struct urdd_robot *handle,
                                           const double *configurations,
                                           size_t rows,
                                           size_t dofs,
                                           double *jacobians,
                                           size_t length);

// Writes the velocities of all DOFs that keep the loops closed, rad/s or m/s, for those of the independent DOFs.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `independent` has `length` values, rows x independent, in
// the order of `urdd_robot_independent_dofs`; `velocities` has room for rows x dofs values. NaN where the others do not
// follow from these: at a dead point, or where parts are in a line. One row is computed on this thread, without an
// allocation.
//
// Errors: also `VALUE` for a velocity that is not finite.
enum urdd_status urdd_robot_loop_velocities(const struct urdd_robot *handle,
                                            const double *configurations,
                                            size_t rows,
                                            size_t dofs,
                                            const double *independent,
                                            size_t length,
                                            double *velocities);

// Writes the number of configurations that a person named; 0 without named_configurations_module.
//
// Errors: `UNUSABLE`: named_configurations_module.
enum urdd_status urdd_robot_num_named_configurations(const struct urdd_robot *handle, size_t *out);

// Writes the name of a named configuration. It lives as long as the robot.
//
// Errors: `OUT_OF_RANGE`; `UNUSABLE`: named_configurations_module.
enum urdd_status urdd_robot_configuration_name(const struct urdd_robot *handle, size_t index, struct urdd_text *out);

// Writes a named configuration: `dofs` values, rad or m.
//
// Errors: `UNKNOWN_NAME`, whose message has the nearest name; `UNUSABLE`: named_configurations_module.
enum urdd_status urdd_robot_named_configuration(const struct urdd_robot *handle,
                                                const char *name,
                                                double *configuration,
                                                size_t dofs);

// Writes the number of links, joints and DOFs. Each of the three can be null.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
enum urdd_status urdd_robot_sizes(const struct urdd_robot *handle, size_t *links, size_t *joints, size_t *dofs);

// Writes the name of a link. It lives as long as the robot.
//
// Errors: `OUT_OF_RANGE`; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
enum urdd_status urdd_robot_link_name(const struct urdd_robot *handle, size_t link, struct urdd_text *out);

// As `urdd_robot_link_name`, for a joint.
enum urdd_status urdd_robot_joint_name(const struct urdd_robot *handle, size_t joint, struct urdd_text *out);

// As `urdd_robot_link_name`, for a DOF: the name of its joint, with the coordinate if the joint has several.
enum urdd_status urdd_robot_dof_name(const struct urdd_robot *handle, size_t dof, struct urdd_text *out);

// Writes the unit of a DOF: "rad" or "m". It lives as long as the library.
//
// Errors: as `urdd_robot_link_name`.
enum urdd_status urdd_robot_dof_unit(const struct urdd_robot *handle, size_t dof, struct urdd_text *out);

// Writes the index of a link.
//
// Errors: `UNKNOWN_NAME`, whose message has the nearest name; `MISSING_MODULE`, `UNUSABLE`: chain_module or
// dof_module.
enum urdd_status urdd_robot_link(const struct urdd_robot *handle, const char *name, size_t *out);

// As `urdd_robot_link`, for a joint.
enum urdd_status urdd_robot_joint(const struct urdd_robot *handle, const char *name, size_t *out);

// Writes the DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
//
// `dofs` has room for `length` indices, of which the first `found` are written: `found` may be more than `length`, and is
// at most the number of DOFs.
//
// Errors: `OUT_OF_RANGE` for a link; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
enum urdd_status urdd_robot_dofs_between(const struct urdd_robot *handle,
                                         size_t base,
                                         size_t tip,
                                         size_t *dofs,
                                         size_t length,
                                         size_t *found);

// As `urdd_robot_link`, for a DOF.
enum urdd_status urdd_robot_dof(const struct urdd_robot *handle, const char *name, size_t *out);

// Makes a box: the pose of its centre and axes, and its 3 half extents, metres.
//
// `pose` is a homogeneous 4 x 4 matrix in row-major order; null is the identity.
//
// Errors: `VALUE` for a size that is negative, not finite or larger than 1e9 m, and for a pose that is not a rotation
// and a translation.
enum urdd_status urdd_obstacle_cuboid(const char *name,
                                      const double *pose,
                                      const double *half_extents,
                                      struct urdd_obstacle **out);

// Makes a sphere: its centre (3 values) and radius, metres.
//
// Errors: as `urdd_obstacle_cuboid`.
enum urdd_status urdd_obstacle_sphere(const char *name,
                                      const double *centre,
                                      double radius,
                                      struct urdd_obstacle **out);

// Makes a capsule: all points within `radius` of a segment along the z axis of its frame, from -`half_length` to
// `half_length`, metres.
//
// Errors: as `urdd_obstacle_cuboid`.
enum urdd_status urdd_obstacle_capsule(const char *name,
                                       const double *pose,
                                       double radius,
                                       double half_length,
                                       struct urdd_obstacle **out);

// Makes a cylinder along the z axis of its frame, from -`half_length` to `half_length`, metres. It is approximated by
// a circumscribed prism with 64 sides, which exceeds the radius by up to 0.13 %.
//
// Errors: as `urdd_obstacle_cuboid`.
enum urdd_status urdd_obstacle_cylinder(const char *name,
                                        const double *pose,
                                        double radius,
                                        double half_length,
                                        struct urdd_obstacle **out);

// Makes the convex hull of `count` points (count x 3), metres.
//
// Errors: as `urdd_obstacle_cuboid`, and `VALUE` without points.
enum urdd_status urdd_obstacle_hull(const char *name,
                                    const double *pose,
                                    const double *points,
                                    size_t count,
                                    struct urdd_obstacle **out);

// Makes a mesh of `num_vertices` vertices (x 3), metres, and `num_triangles` triangles (x 3 indices), decomposed into
// convex pieces as `urdd generate` does, at the same cost. `urdd_obstacle_hull` is fast, and fills cavities.
//
// Errors: as `urdd_obstacle_hull`, and `OUT_OF_RANGE` for a vertex index.
enum urdd_status urdd_obstacle_mesh(const char *name,
                                    const double *pose,
                                    const double *vertices,
                                    size_t num_vertices,
                                    const uint32_t *triangles,
                                    size_t num_triangles,
                                    struct urdd_obstacle **out);

// Makes a cloud of `count` points (count x 3), metres, such as a depth camera sees: all points that are at most `radius`
// from one of them; 0 is allowed. It is one part, in which a tree finds the points near a shape: 100,000 are fine.
//
// Errors: as `urdd_obstacle_hull`.
enum urdd_status urdd_obstacle_points(const char *name,
                                      const double *pose,
                                      const double *points,
                                      size_t count,
                                      double radius,
                                      struct urdd_obstacle **out);

// Makes a field of heights over the x-y plane of its frame: `rows` x `columns` columns, row by row, each with the 2 sizes
// `cell` along x and y, metres. The centre of one is at `x = column * cell[0]`, `y = row * cell[1]`. It reaches from its height,
// metres, `thickness` down. There are no slopes between cells.
//
// Errors: as `urdd_obstacle_cuboid`, and `VALUE` without heights.
enum urdd_status urdd_obstacle_height_field(const char *name,
                                            const double *pose,
                                            const double *heights,
                                            size_t rows,
                                            size_t columns,
                                            const double *cell,
                                            double thickness,
                                            struct urdd_obstacle **out);

// Makes the same obstacle again, with a link that may touch it, such as the base that is mounted on it. `obstacle`
// stays as it is.
enum urdd_status urdd_obstacle_ignoring(const struct urdd_obstacle *obstacle,
                                        const char *link,
                                        struct urdd_obstacle **out);

// Makes the same body with its frame at another pose: a matrix, 16 values, row by row. Nothing is prepared again: the
// two share their shapes. The frame of a sphere is at its centre. `urdd_world_proximity_move_obstacles` moves without a
// new handle.
//
// Errors: `VALUE` for NaN or infinity, or a matrix that is not a rotation and a translation.
enum urdd_status urdd_obstacle_at(const struct urdd_obstacle *obstacle, const double *pose, struct urdd_obstacle **out);

// Frees an obstacle. What was made of it stays. Null is ignored.
enum urdd_status urdd_obstacle_free(struct urdd_obstacle *obstacle);

// Writes whether any pair is at most `margin` apart, metres, for each configuration. With a margin above 0, pairs count
// whose links can move against each other.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `within` has room for `rows` values. One row is computed
// on this thread, without an allocation.
//
// Errors: `VALUE` for a margin below 0.
enum urdd_status urdd_proximity_is_within(const struct urdd_proximity *handle,
                                          const double *configurations,
                                          size_t rows,
                                          size_t dofs,
                                          double margin,
                                          bool *within);

// As `urdd_proximity_is_within`, for the pairs of a shape of the robot and an obstacle.
enum urdd_status urdd_world_proximity_is_within(const struct urdd_world_proximity *handle,
                                                const double *configurations,
                                                size_t rows,
                                                size_t dofs,
                                                double margin,
                                                bool *within);

// Writes where each straight motion is blocked by the robot itself, as a part of it from 0 to 1; NaN where it is free.
//
// `starts` and `ends` have `rows` rows of `dofs` values each, rad or m; `blocked` has room for `rows` values. `margin`
// is the distance that must be kept, metres. With a `resolution` above 0, metres, configurations are checked between
// which no point of the robot travels farther, the end and the halves first: the answer is one that is blocked, and need
// not be the first, which `urdd_proximity_first_contact` has. With 0, the motion is proved free by conservative
// advancement; it then needs 0.1 mm more than the margin, and the answer is the first part where it has less.
//
// Where the robot has kinematic loops, they stay closed in the motion: see `urdd_proximity_motions`.
//
// Errors: `VALUE` for a margin or a resolution below 0, or a motion that needs more than a
// million configurations, or 100,000 steps of a proof; for a robot with loops as `urdd_proximity_motions`.
enum urdd_status urdd_proximity_blocked_edge(const struct urdd_proximity *handle,
                                             const double *starts,
                                             const double *ends,
                                             size_t rows,
                                             size_t dofs,
                                             double margin,
                                             double resolution,
                                             double *blocked);

// As `urdd_proximity_blocked_edge`, for motions that obstacles block.
enum urdd_status urdd_world_proximity_blocked_edge(const struct urdd_world_proximity *handle,
                                                   const double *starts,
                                                   const double *ends,
                                                   size_t rows,
                                                   size_t dofs,
                                                   double margin,
                                                   double resolution,
                                                   double *blocked);

// Writes where each straight motion is blocked by the robot itself first, and how far it is free.
//
// As `urdd_proximity_blocked_edge`; `contacts` has room for `length` values, rows x 2: the last part of the motion that is
// known to be free (0 if the start is not), then the first that is not; both NaN where the motion is free. With a
// resolution, configurations are checked in order, and the part between the first that is blocked and the one before is
// halved ten times: between the two no point of the robot travels farther than a thousandth of the resolution. A contact
// that begins and ends between two configurations can be missed. With 0, all up to the first part is proved free.
enum urdd_status urdd_proximity_first_contact(const struct urdd_proximity *handle,
                                              const double *starts,
                                              const double *ends,
                                              size_t rows,
                                              size_t dofs,
                                              double margin,
                                              double resolution,
                                              double *contacts,
                                              size_t length);

// As `urdd_proximity_first_contact`, for motions that obstacles block.
enum urdd_status urdd_world_proximity_first_contact(const struct urdd_world_proximity *handle,
                                                    const double *starts,
                                                    const double *ends,
                                                    size_t rows,
                                                    size_t dofs,
                                                    double margin,
                                                    double resolution,
                                                    double *contacts,
                                                    size_t length);

// Writes where each motion is blocked by the robot itself first, and why.
//
// As `urdd_proximity_first_contact`; `motions` has room for `rows`. Where the robot has kinematic loops, the motion is the
// one in which they stay closed: the independent DOFs go straight, the others follow, each configuration closed from the
// last one, within the bounds. It is blocked where no closed configuration is found, and at the end where the others
// arrive on another branch than `ends` is on. It has no proof. With `open_loops`, it is the straight motion of the
// spanning tree.
//
// Errors: as there; for a robot with loops also `VALUE` without a resolution, for an end that is not closed, and for a
// motion that needs more than 100,000 configurations.
enum urdd_status urdd_proximity_motions(const struct urdd_proximity *handle,
                                        const double *starts,
                                        const double *ends,
                                        size_t rows,
                                        size_t dofs,
                                        double margin,
                                        double resolution,
                                        bool open_loops,
                                        struct urdd_motion *motions);

// As `urdd_proximity_motions`, for motions that obstacles block.
enum urdd_status urdd_world_proximity_motions(const struct urdd_world_proximity *handle,
                                              const double *starts,
                                              const double *ends,
                                              size_t rows,
                                              size_t dofs,
                                              double margin,
                                              double resolution,
                                              bool open_loops,
                                              struct urdd_motion *motions);

// Writes the `k` nearest pairs of one configuration, nearest first, and the gradients of their distances.
//
// `configuration` has `dofs` values, rad or m; `nearest` has room for `k`; `gradients` for k x dofs values, m/rad or
// m/m: NaN for pairs that touch or overlap. `found` is the number that is written: the lesser of `k` and the number of
// pairs. A gradient is that of the closest points as they are.
enum urdd_status urdd_proximity_gradients(const struct urdd_proximity *handle,
                                          const double *configuration,
                                          size_t dofs,
                                          size_t k,
                                          struct urdd_pair_distance *nearest,
                                          double *gradients,
                                          size_t *found);

// As `urdd_proximity_gradients`, for the pairs of a shape of the robot and a convex part of an obstacle.
enum urdd_status urdd_world_proximity_gradients(const struct urdd_world_proximity *handle,
                                                const double *configuration,
                                                size_t dofs,
                                                size_t k,
                                                struct urdd_obstacle_distance *nearest,
                                                double *gradients,
                                                size_t *found);

// Writes the pairs that touch or overlap in one configuration, with the least translation that separates them.
//
// `configuration` has `dofs` values, rad or m; `overlaps` has room for `length`, of which the first `found` are written:
// `found` may be more than `length`, and is at most the number of pairs.
enum urdd_status urdd_proximity_penetrations(const struct urdd_proximity *handle,
                                             const double *configuration,
                                             size_t dofs,
                                             struct urdd_overlap *overlaps,
                                             size_t length,
                                             size_t *found);

// As `urdd_proximity_penetrations`, for the pairs of a shape of the robot and a convex part of an obstacle.
enum urdd_status urdd_world_proximity_penetrations(const struct urdd_world_proximity *handle,
                                                   const double *configuration,
                                                   size_t dofs,
                                                   struct urdd_obstacle_overlap *overlaps,
                                                   size_t length,
                                                   size_t *found);

// Prepares the shapes of a kind, without the pairs that the URDD skips. It reads the meshes.
//
// `kind` is "hulls", "boxes", "spheres", "pieces", "piece-boxes" or "piece-spheres".
//
// Errors: `UNKNOWN_NAME` for the kind; `MISSING_MODULE`, `UNUSABLE`: the module of the shapes, a skips module,
// chain_module or dof_module, or a mesh.
enum urdd_status urdd_robot_proximity(const struct urdd_robot *handle, const char *kind, struct urdd_proximity **out);

// Frees a proximity. What was made of it stays. Null is ignored.
enum urdd_status urdd_proximity_free(struct urdd_proximity *proximity);

// Writes the number of shapes, of pairs that are checked, and of DOFs. Each of the three can be null.
enum urdd_status urdd_proximity_sizes(const struct urdd_proximity *handle, size_t *shapes, size_t *pairs, size_t *dofs);

// Writes the pairs that are checked, in the order of `urdd_proximity_distances`.
enum urdd_status urdd_proximity_pairs(const struct urdd_proximity *handle, struct urdd_pair *pairs, size_t length);

// Writes whether any pair touches or overlaps, for each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values. One row is
// computed on this thread, without an allocation.
enum urdd_status urdd_proximity_in_collision(const struct urdd_proximity *handle,
                                             const double *configurations,
                                             size_t rows,
                                             size_t dofs,
                                             bool *colliding);

// Writes the minimum distance over all pairs for each configuration, metres: 0 in a collision, infinite without pairs.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `rows` values.
enum urdd_status urdd_proximity_self_distance(const struct urdd_proximity *handle,
                                              const double *configurations,
                                              size_t rows,
                                              size_t dofs,
                                              double *distances);

// Writes the distance of each pair for each configuration, metres: 0 for pairs that touch or overlap.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `length` values: rows x pairs,
// in the order of `urdd_proximity_pairs`. One row is computed on this thread, without an allocation.
enum urdd_status urdd_proximity_distances(const struct urdd_proximity *handle,
                                          const double *configurations,
                                          size_t rows,
                                          size_t dofs,
                                          double *distances,
                                          size_t length);

// Writes the `k` nearest pairs for each configuration, nearest first, with their closest points.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `nearest` has room for rows x k. `found` is the number
// that is written of each row: the lesser of `k` and the number of pairs. One row is computed on this thread, without an
// allocation.
enum urdd_status urdd_proximity_nearest(const struct urdd_proximity *handle,
                                        const double *configurations,
                                        size_t rows,
                                        size_t dofs,
                                        size_t k,
                                        struct urdd_pair_distance *nearest,
                                        size_t *found);

// Writes the distance and the closest points of each pair for each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m; `closest` has room for `length`: rows x pairs, in the
// order of `urdd_proximity_pairs`.
enum urdd_status urdd_proximity_closest_points(const struct urdd_proximity *handle,
                                               const double *configurations,
                                               size_t rows,
                                               size_t dofs,
                                               struct urdd_pair_distance *closest,
                                               size_t length);

// Opens the URDD in a folder or zip archive. Lists a folder's files, and reads no module yet: a call that needs one
// reads it, and it is kept.
//
// `path` is in UTF-8. Errors: `OPEN` if there is no URDD.
enum urdd_status urdd_robot_open(const char *path, struct urdd_robot **out);

// Opens the URDD in a zip archive in memory. The bytes are copied. `name` stands for the archive in messages.
//
// Errors: `OPEN` if the bytes are not a zip archive.
enum urdd_status urdd_robot_of_archive(const char *name, const uint8_t *bytes, size_t length, struct urdd_robot **out);

// Frees a robot. What was made of it stays. Null is ignored.
enum urdd_status urdd_robot_free(struct urdd_robot *robot);

// Reads the skips between the shapes of a kind. `kind` is as for `urdd_robot_proximity`.
//
// Errors: `UNKNOWN_NAME` for the kind; `MISSING_MODULE`, `UNUSABLE`: the skips modules.
enum urdd_status urdd_robot_skips(const struct urdd_robot *handle, const char *kind, struct urdd_skips **out);

// Frees skips. Null is ignored.
enum urdd_status urdd_skips_free(struct urdd_skips *skips);

// Writes the number of shapes.
enum urdd_status urdd_skips_len(const struct urdd_skips *handle, size_t *out);

// Writes the link and the piece of each shape.
enum urdd_status urdd_skips_places(const struct urdd_skips *handle, struct urdd_shape_place *places, size_t length);

// Writes whether a pair of shapes is skipped, by their indices. A shape with itself is.
//
// Errors: `OUT_OF_RANGE`.
enum urdd_status urdd_skips_is_skipped(const struct urdd_skips *handle, size_t i, size_t j, bool *out);

// Writes the lower and the upper bound of each DOF, rad or m: dofs x 2 values. Those of a rotation vector include all
// rotations. Those of other DOFs that are not limited are a range to sample from, [-pi, pi] or [-1, 1], which the DOF
// may leave: `urdd_robot_dof_is_limited` says which.
//
// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module or bounds_module.
enum urdd_status urdd_robot_bounds(const struct urdd_robot *handle, double *bounds, size_t length);

// Writes for each DOF whether the source limits it: false for continuous, planar, floating and spherical joints.
// `limited` has room for `dofs` values.
//
// Errors: as `urdd_robot_bounds`.
enum urdd_status urdd_robot_dof_is_limited(const struct urdd_robot *handle, bool *limited, size_t dofs);

// Writes the default configuration (SPEC 9.4): every DOF at 0, or at the bound nearest to 0. `dofs` values, rad or m.
//
// Errors: as `urdd_robot_bounds`.
enum urdd_status urdd_robot_zero(const struct urdd_robot *handle, double *configuration, size_t dofs);

// As `urdd_robot_zero`, for the configuration with every DOF half-way between its bounds.
enum urdd_status urdd_robot_middle(const struct urdd_robot *handle, double *configuration, size_t dofs);

// Writes `rows` samples of the sequence that SPEC 9.3 defines, from number `first` on: uniform within the bounds, and
// the same in every implementation. rows x dofs values, rad or m.
//
// Errors: as `urdd_robot_bounds`.
enum urdd_status urdd_robot_random(const struct urdd_robot *handle,
                                   uint64_t first,
                                   double *configurations,
                                   size_t rows,
                                   size_t dofs);

// Moves each of the `dofs` values of a configuration that is beyond its bounds to the nearer bound. Leaves rotation
// vectors as they are.
//
// Errors: as `urdd_robot_bounds`.
enum urdd_status urdd_robot_clamp(const struct urdd_robot *handle, double *configuration, size_t dofs);

// Prepares the finest level of spheres that covers the links, with the coarser ones around it, as the URDD has them
// (link_shapes_spheres_module), for the pairs of links that are neither skipped nor ignored by the level.
//
// Errors: `MISSING_MODULE` without the module, or without a level that covers; `UNUSABLE`: the module, a skips module,
// chain_module or dof_module.
enum urdd_status urdd_robot_covering_checker(const struct urdd_robot *handle, struct urdd_covering_checker **out);

// As `urdd_robot_covering_checker`, of spheres of the caller's that cover the shapes, and of `num_pairs` pairs of links,
// such as those of `urdd_proximity_pairs`. A link without spheres on the finest level is left out.
//
// Errors: `VALUE` for a centre that is not finite or farther than 1e9 m, a radius that is not above 0 or larger than that,
// a level that is left out, no spheres, or a pair of a link with itself; `OUT_OF_RANGE` for a link.
enum urdd_status urdd_robot_covering_checker_of(const struct urdd_robot *handle,
                                                const struct urdd_link_sphere *spheres,
                                                size_t count,
                                                const struct urdd_link_pair *pairs,
                                                size_t num_pairs,
                                                struct urdd_covering_checker **out);

// Frees a checker. What was made of it stays. Null is ignored.
enum urdd_status urdd_covering_checker_free(struct urdd_covering_checker *checker);

// Writes the number of DOFs.
enum urdd_status urdd_covering_checker_num_dofs(const struct urdd_covering_checker *handle, size_t *out);

// Makes a checker of the same spheres among `count` obstacles: each query then asks for both, contacts of links with each
// other and with obstacles. What it needs of the obstacles is copied; those of `handle` are not kept.
//
// Errors: `UNKNOWN_NAME` if an obstacle ignores an unknown link.
enum urdd_status urdd_covering_checker_around(const struct urdd_covering_checker *handle,
                                              const struct urdd_obstacle *const *obstacles,
                                              size_t count,
                                              struct urdd_covering_checker **out);

// Moves obstacles, as `urdd_world_proximity_move_obstacles` does: it changes the handle.
enum urdd_status urdd_covering_checker_move_obstacles(struct urdd_covering_checker *handle,
                                                      size_t first,
                                                      const double *poses,
                                                      size_t count);

// Writes what the spheres say of each configuration.
//
// `configurations` has `rows` rows of `dofs` values, rad or m, at most 1e9; `answers` has room for `rows` values. Eight rows
// are checked at once. One row is computed on this thread, without an allocation.
//
// Errors: `VALUE` for a value beyond 1e9.
enum urdd_status urdd_covering_checker_in_collision(const struct urdd_covering_checker *handle,
                                                    const double *configurations,
                                                    size_t rows,
                                                    size_t dofs,
                                                    enum urdd_covering_answer *answers);

// As `urdd_covering_checker_in_collision`, of spheres that are at most `margin` apart, metres. With a margin above 0, pairs
// count whose links can move against each other.
//
// Errors: also `VALUE` for a margin below 0.
enum urdd_status urdd_covering_checker_is_within(const struct urdd_covering_checker *handle,
                                                 const double *configurations,
                                                 size_t rows,
                                                 size_t dofs,
                                                 double margin,
                                                 enum urdd_covering_answer *answers);

// Writes where spheres touch on each straight motion, as a part of it from 0 to 1; NaN where they do not.
//
// `starts` and `ends` have `rows` rows of `dofs` values each, rad or m; `blocked` has room for `rows` values. `margin` is
// the distance that must be kept, metres. Configurations are checked between which no point of a sphere travels farther
// than `resolution`, metres, eight at once, spread over the whole motion: the answer need not be the first part, which
// `urdd_covering_checker_first_contact` has. `open_loops` says that kinematic loops may be open on the way: spheres follow
// no motion in which they stay closed.
//
// Errors: `VALUE` for a margin below 0, a resolution that is not above 0, a value beyond 1e9, or a motion that needs more
// than a million configurations; for a robot with loops without `open_loops`.
enum urdd_status urdd_covering_checker_blocked_edge(const struct urdd_covering_checker *handle,
                                                    const double *starts,
                                                    const double *ends,
                                                    size_t rows,
                                                    size_t dofs,
                                                    double margin,
                                                    double resolution,
                                                    bool open_loops,
                                                    double *blocked);

// Writes where spheres touch first on each straight motion, and how far they are free.
//
// As `urdd_covering_checker_blocked_edge`; `contacts` has room for `length` values, rows x 2: the last part of the motion in
// which no spheres touch (0 if they do at the start), then the first in which some do; both NaN where the motion is free.
// The part between two configurations is divided by 4096.
enum urdd_status urdd_covering_checker_first_contact(const struct urdd_covering_checker *handle,
                                                     const double *starts,
                                                     const double *ends,
                                                     size_t rows,
                                                     size_t dofs,
                                                     double margin,
                                                     double resolution,
                                                     bool open_loops,
                                                     double *contacts,
                                                     size_t length);

// Prepares the last level of spheres that does not cover the links: fitted ones, or those that a person gave. How often it
// is wrong stands in the level's `evaluation` in link_shapes_spheres_module.
//
// Errors: as `urdd_robot_covering_checker`.
enum urdd_status urdd_robot_approximating_checker(const struct urdd_robot *handle,
                                                  struct urdd_approximating_checker **out);

// As `urdd_robot_covering_checker_of`, of spheres that need not cover the shapes.
enum urdd_status urdd_robot_approximating_checker_of(const struct urdd_robot *handle,
                                                     const struct urdd_link_sphere *spheres,
                                                     size_t count,
                                                     const struct urdd_link_pair *pairs,
                                                     size_t num_pairs,
                                                     struct urdd_approximating_checker **out);

// Frees a checker. What was made of it stays. Null is ignored.
enum urdd_status urdd_approximating_checker_free(struct urdd_approximating_checker *checker);

// Writes the number of DOFs.
enum urdd_status urdd_approximating_checker_num_dofs(const struct urdd_approximating_checker *handle, size_t *out);

// As `urdd_covering_checker_around`.
enum urdd_status urdd_approximating_checker_around(const struct urdd_approximating_checker *handle,
                                                   const struct urdd_obstacle *const *obstacles,
                                                   size_t count,
                                                   struct urdd_approximating_checker **out);

// As `urdd_covering_checker_move_obstacles`.
enum urdd_status urdd_approximating_checker_move_obstacles(struct urdd_approximating_checker *handle,
                                                           size_t first,
                                                           const double *poses,
                                                           size_t count);

// As `urdd_covering_checker_in_collision`.
enum urdd_status urdd_approximating_checker_in_collision(const struct urdd_approximating_checker *handle,
                                                         const double *configurations,
                                                         size_t rows,
                                                         size_t dofs,
                                                         enum urdd_approximate_answer *answers);

// As `urdd_covering_checker_is_within`.
enum urdd_status urdd_approximating_checker_is_within(const struct urdd_approximating_checker *handle,
                                                      const double *configurations,
                                                      size_t rows,
                                                      size_t dofs,
                                                      double margin,
                                                      enum urdd_approximate_answer *answers);

// As `urdd_covering_checker_blocked_edge`.
enum urdd_status urdd_approximating_checker_blocked_edge(const struct urdd_approximating_checker *handle,
                                                         const double *starts,
                                                         const double *ends,
                                                         size_t rows,
                                                         size_t dofs,
                                                         double margin,
                                                         double resolution,
                                                         bool open_loops,
                                                         double *blocked);

// As `urdd_covering_checker_first_contact`.
enum urdd_status urdd_approximating_checker_first_contact(const struct urdd_approximating_checker *handle,
                                                          const double *starts,
                                                          const double *ends,
                                                          size_t rows,
                                                          size_t dofs,
                                                          double margin,
                                                          double resolution,
                                                          bool open_loops,
                                                          double *contacts,
                                                          size_t length);

// Validates every URDD at or below a path, as `urdd validate` does: a folder, a zip archive, or a folder of them.
//
// `settings` is the text of a `urdd.toml` (docs/validate.md); null is an empty one. No settings are read from disk.
//
// Errors: `OPEN` if there is no URDD; `VALUE` for the settings. Findings are no error: the report has them.
enum urdd_status urdd_validate(const char *path, const char *settings, struct urdd_report **out);

// Validates the URDD in a zip archive in memory. `name` is its name in the report.
//
// Errors: `OPEN` if the bytes are not a zip archive; `VALUE` for the settings.
enum urdd_status urdd_validate_archive(const char *name,
                                       const uint8_t *bytes,
                                       size_t length,
                                       const char *settings,
                                       struct urdd_report **out);

// Writes the report: the JSON of `urdd validate --format json` (schema/report). It lives as long as the report.
enum urdd_status urdd_report_json(const struct urdd_report *handle, struct urdd_text *out);

// Writes whether every URDD passes.
enum urdd_status urdd_report_passes(const struct urdd_report *handle, bool *out);

// Frees a report. Null is ignored.
enum urdd_status urdd_report_free(struct urdd_report *report);

// Prepares the shapes of a robot and `count` obstacles. Skips do not apply: every shape of the robot is checked
// against every obstacle, without the links that the obstacle ignores. What it needs of the obstacles is copied.
//
// Errors: `UNKNOWN_NAME` if an obstacle ignores an unknown link.
enum urdd_status urdd_proximity_world_proximity(const struct urdd_proximity *proximity,
                                                const struct urdd_obstacle *const *obstacles,
                                                size_t count,
                                                struct urdd_world_proximity **out);

// Frees a robot's shapes and obstacles. Null is ignored.
enum urdd_status urdd_world_proximity_free(struct urdd_world_proximity *world);

// As `urdd_proximity_in_collision`, for the pairs of a shape of the robot and an obstacle.
enum urdd_status urdd_world_proximity_in_collision(const struct urdd_world_proximity *handle,
                                                   const double *configurations,
                                                   size_t rows,
                                                   size_t dofs,
                                                   bool *colliding);

// As `urdd_proximity_self_distance`, for the pairs of a shape of the robot and an obstacle.
enum urdd_status urdd_world_proximity_min_distance(const struct urdd_world_proximity *handle,
                                                   const double *configurations,
                                                   size_t rows,
                                                   size_t dofs,
                                                   double *distances);

// As `urdd_proximity_nearest`, for the pairs of a shape of the robot and a convex part of an obstacle.
enum urdd_status urdd_world_proximity_nearest(const struct urdd_world_proximity *handle,
                                              const double *configurations,
                                              size_t rows,
                                              size_t dofs,
                                              size_t k,
                                              struct urdd_obstacle_distance *nearest,
                                              size_t *found);

// Writes the number of pairs that `urdd_world_proximity_distances` has, of a shape of the robot and an obstacle; the
// number of pairs of a shape and a convex part of an obstacle, the most that `urdd_world_proximity_nearest` finds; and the
// number of DOFs. Each of the three can be null.
enum urdd_status urdd_world_proximity_sizes(const struct urdd_world_proximity *handle,
                                            size_t *pairs,
                                            size_t *pairs_of_parts,
                                            size_t *dofs);

// Writes the pairs that are checked, in the order of `urdd_world_proximity_distances`.
enum urdd_status urdd_world_proximity_pairs(const struct urdd_world_proximity *handle,
                                            struct urdd_obstacle_pair *pairs,
                                            size_t length);

// As `urdd_proximity_distances`, for the pairs of a shape of the robot and an obstacle, in the order of
// `urdd_world_proximity_pairs`.
enum urdd_status urdd_world_proximity_distances(const struct urdd_world_proximity *handle,
                                                const double *configurations,
                                                size_t rows,
                                                size_t dofs,
                                                double *distances,
                                                size_t length);

// Moves obstacles to other poses: those from index `first` on, to `count` matrices (x 16 values, row by row). Nothing is
// prepared again, and nothing is allocated after the first call of a thread. Functions of this name alone change a handle:
// no other thread uses it during the call. After an error, none has moved.
//
// Errors: `OUT_OF_RANGE` if there are fewer obstacles; `VALUE` for NaN or infinity, or a matrix that is not a rotation and
// a translation.
enum urdd_status urdd_world_proximity_move_obstacles(struct urdd_world_proximity *handle,
                                                     size_t first,
                                                     const double *poses,
                                                     size_t count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* URDD_H */
