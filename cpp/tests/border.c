/* The header is C, and every function answers a call with nothing right in it. Run under valgrind by .ci/cpp. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <urdd.h>

#undef NDEBUG
#include <assert.h>

static void ok(urdd_status status) {
    if (status != URDD_STATUS_OK) {
        fprintf(stderr, "%d: %s\n", (int)status, urdd_error_message().data);
        abort();
    }
}

static void fails(urdd_status status, urdd_status expected, const char *words) {
    const char *said = urdd_error_message().data;
    if (status != expected || strstr(said, words) == NULL) {
        fprintf(stderr, "expected %d with \"%s\", found %d: %s\n", (int)expected, words, (int)status, said);
        abort();
    }
}

/* Every function with null wherever a pointer is, and numbers that no memory has. */
static void nulls(void) {
    size_t many = (size_t)-1;
    urdd_status all[] = {
        urdd_robot_open(NULL, NULL),
        urdd_robot_of_archive(NULL, NULL, many, NULL),
        urdd_robot_sizes(NULL, NULL, NULL, NULL),
        urdd_robot_link_name(NULL, many, NULL),
        urdd_robot_joint_name(NULL, many, NULL),
        urdd_robot_dof_name(NULL, many, NULL),
        urdd_robot_dof_unit(NULL, many, NULL),
        urdd_robot_link(NULL, NULL, NULL),
        urdd_robot_dof(NULL, NULL, NULL),
        urdd_robot_joint(NULL, NULL, NULL),
        urdd_robot_dofs_between(NULL, many, many, NULL, many, NULL),
        urdd_robot_bounds(NULL, NULL, many),
        urdd_robot_zero(NULL, NULL, many),
        urdd_robot_middle(NULL, NULL, many),
        urdd_robot_random(NULL, 0, NULL, many, many),
        urdd_robot_clamp(NULL, NULL, many),
        urdd_robot_velocity_limits(NULL, NULL, many),
        urdd_robot_effort_limits(NULL, NULL, many),
        urdd_robot_link_masses(NULL, NULL, many),
        urdd_robot_centre_of_mass(NULL, NULL, many, many, NULL),
        urdd_robot_gravity_torques(NULL, NULL, many, many, NULL, 1.0, many, NULL, NULL, many),
        urdd_robot_num_named_configurations(NULL, NULL),
        urdd_robot_configuration_name(NULL, many, NULL),
        urdd_robot_named_configuration(NULL, NULL, NULL, many),
        urdd_robot_link_poses(NULL, NULL, many, many, NULL, many),
        urdd_robot_jacobians(NULL, NULL, many, many, many, NULL, NULL, many),
        urdd_robot_loop_sizes(NULL, NULL, NULL, NULL, NULL),
        urdd_robot_loop_name(NULL, many, NULL),
        urdd_robot_coupling_name(NULL, many, NULL),
        urdd_robot_reference_configuration(NULL, NULL, many),
        urdd_robot_loop_errors(NULL, NULL, many, many, NULL, many, NULL, many, NULL),
        urdd_robot_close(NULL, NULL, many, many, NULL, many, NULL, many, NULL, NULL),
        urdd_robot_independent_dofs(NULL, NULL, many),
        urdd_robot_free_dofs(NULL, NULL, many, NULL),
        urdd_robot_loop_residuals(NULL, NULL, many, many, NULL, many),
        urdd_robot_loop_jacobians(NULL, NULL, many, many, NULL, many),
        urdd_robot_loop_velocities(NULL, NULL, many, many, NULL, many, NULL),
        urdd_proximity_motions(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL),
        urdd_world_proximity_motions(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL),
        urdd_inverse_settings_default(NULL),
        urdd_robot_inverse_kinematics(NULL, NULL, many, NULL, many, many, NULL, NULL, NULL),
        urdd_robot_proximity(NULL, NULL, NULL),
        urdd_proximity_sizes(NULL, NULL, NULL, NULL),
        urdd_proximity_pairs(NULL, NULL, many),
        urdd_proximity_in_collision(NULL, NULL, many, many, NULL),
        urdd_proximity_self_distance(NULL, NULL, many, many, NULL),
        urdd_proximity_distances(NULL, NULL, many, many, NULL, many),
        urdd_proximity_nearest(NULL, NULL, many, many, many, NULL, NULL),
        urdd_proximity_closest_points(NULL, NULL, many, many, NULL, many),
        urdd_proximity_is_within(NULL, NULL, many, many, 0.1, NULL),
        urdd_proximity_blocked_edge(NULL, NULL, NULL, many, many, 0.1, 0.1, NULL),
        urdd_proximity_gradients(NULL, NULL, many, many, NULL, NULL, NULL),
        urdd_proximity_penetrations(NULL, NULL, many, NULL, many, NULL),
        urdd_proximity_attach(NULL, many, NULL, NULL),
        urdd_proximity_without(NULL, NULL, many, NULL),
        urdd_proximity_without_bodies(NULL, NULL, many, NULL),
        urdd_proximity_num_bodies(NULL, NULL),
        urdd_proximity_body(NULL, NULL, NULL),
        urdd_proximity_body_name(NULL, many, NULL),
        urdd_proximity_first_contact(NULL, NULL, NULL, many, many, 0.1, 0.1, NULL, many),
        urdd_world_proximity_first_contact(NULL, NULL, NULL, many, many, 0.1, 0.1, NULL, many),
        urdd_world_proximity_sizes(NULL, NULL, NULL, NULL),
        urdd_world_proximity_pairs(NULL, NULL, many),
        urdd_world_proximity_distances(NULL, NULL, many, many, NULL, many),
        urdd_world_proximity_penetrations(NULL, NULL, many, NULL, many, NULL),
        urdd_world_proximity_move_obstacles(NULL, many, NULL, many),
        urdd_robot_dof_is_limited(NULL, NULL, many),
        urdd_obstacle_cuboid(NULL, NULL, NULL, NULL),
        urdd_obstacle_sphere(NULL, NULL, 1.0, NULL),
        urdd_obstacle_capsule(NULL, NULL, 1.0, 1.0, NULL),
        urdd_obstacle_cylinder(NULL, NULL, 1.0, 1.0, NULL),
        urdd_obstacle_hull(NULL, NULL, NULL, many, NULL),
        urdd_obstacle_mesh(NULL, NULL, NULL, many, NULL, many, NULL),
        urdd_obstacle_ignoring(NULL, NULL, NULL),
        urdd_obstacle_at(NULL, NULL, NULL),
        urdd_proximity_world_proximity(NULL, NULL, many, NULL),
        urdd_world_proximity_in_collision(NULL, NULL, many, many, NULL),
        urdd_world_proximity_min_distance(NULL, NULL, many, many, NULL),
        urdd_world_proximity_nearest(NULL, NULL, many, many, many, NULL, NULL),
        urdd_world_proximity_is_within(NULL, NULL, many, many, 0.1, NULL),
        urdd_world_proximity_blocked_edge(NULL, NULL, NULL, many, many, 0.1, 0.1, NULL),
        urdd_world_proximity_gradients(NULL, NULL, many, many, NULL, NULL, NULL),
        urdd_obstacle_points(NULL, NULL, NULL, many, 1.0, NULL),
        urdd_obstacle_height_field(NULL, NULL, NULL, many, many, NULL, 1.0, NULL),
        urdd_robot_covering_checker(NULL, NULL),
        urdd_robot_covering_checker_of(NULL, NULL, many, NULL, many, NULL),
        urdd_covering_checker_num_dofs(NULL, NULL),
        urdd_covering_checker_around(NULL, NULL, many, NULL),
        urdd_covering_checker_move_obstacles(NULL, many, NULL, many),
        urdd_covering_checker_in_collision(NULL, NULL, many, many, NULL),
        urdd_covering_checker_is_within(NULL, NULL, many, many, 0.1, NULL),
        urdd_covering_checker_blocked_edge(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL),
        urdd_covering_checker_first_contact(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL, many),
        urdd_robot_approximating_checker(NULL, NULL),
        urdd_robot_approximating_checker_of(NULL, NULL, many, NULL, many, NULL),
        urdd_approximating_checker_num_dofs(NULL, NULL),
        urdd_approximating_checker_around(NULL, NULL, many, NULL),
        urdd_approximating_checker_move_obstacles(NULL, many, NULL, many),
        urdd_approximating_checker_in_collision(NULL, NULL, many, many, NULL),
        urdd_approximating_checker_is_within(NULL, NULL, many, many, 0.1, NULL),
        urdd_approximating_checker_blocked_edge(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL),
        urdd_approximating_checker_first_contact(NULL, NULL, NULL, many, many, 0.1, 0.1, false, NULL, many),
        urdd_robot_collision_model(NULL, NULL),
        urdd_collision_model_evaluation(NULL, NULL),
        urdd_collision_model_sizes(NULL, NULL, NULL),
        urdd_collision_model_pairs(NULL, NULL, many),
        urdd_collision_model_clearances(NULL, NULL, many, many, NULL, many),
        urdd_collision_model_may_collide(NULL, NULL, many, many, NULL),
        urdd_robot_skips(NULL, NULL, NULL),
        urdd_skips_len(NULL, NULL),
        urdd_skips_places(NULL, NULL, many),
        urdd_skips_is_skipped(NULL, many, many, NULL),
        urdd_validate(NULL, NULL, NULL),
        urdd_validate_archive(NULL, NULL, many, NULL, NULL),
        urdd_report_json(NULL, NULL),
        urdd_report_passes(NULL, NULL),
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        assert(all[k] == URDD_STATUS_POINTER || all[k] == URDD_STATUS_LENGTH);
    }
    ok(urdd_robot_free(NULL));
    ok(urdd_proximity_free(NULL));
    ok(urdd_obstacle_free(NULL));
    ok(urdd_world_proximity_free(NULL));
    ok(urdd_covering_checker_free(NULL));
    ok(urdd_approximating_checker_free(NULL));
    ok(urdd_collision_model_free(NULL));
    ok(urdd_skips_free(NULL));
    ok(urdd_report_free(NULL));
}

/* A batch of a robot that is read here: as many as collide. */
static size_t colliding(const char *path) {
    enum { ROWS = 300 };
    urdd_robot *robot = NULL;
    urdd_proximity *proximity = NULL;
    urdd_report *report = NULL;
    size_t dofs = 0, found = 0;
    bool touches[ROWS];
    ok(urdd_robot_open(path, &robot));
    ok(urdd_robot_sizes(robot, NULL, NULL, &dofs));
    double *q = malloc(ROWS * dofs * sizeof *q);
    assert(q != NULL);
    ok(urdd_robot_random(robot, 0, q, ROWS, dofs));
    ok(urdd_robot_proximity(robot, "pieces", &proximity));
    ok(urdd_proximity_in_collision(proximity, q, ROWS, dofs, touches));
    for (size_t k = 0; k < ROWS; ++k) {
        found += touches[k];
    }
    ok(urdd_validate(path, NULL, &report));
    ok(urdd_report_free(report));
    ok(urdd_proximity_free(proximity));
    ok(urdd_robot_free(robot));
    free(q);
    return found;
}

/* A child of `fork` answers, without the threads of its parent. */
static void forked(const char *path) {
    const size_t known = colliding(path);
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        /* Not `exit`: valgrind would look for what the threads that are gone have left. */
        const char *answer = colliding(path) == known ? "true" : "false";
        execlp(answer, answer, (char *)NULL);
        _exit(2);
    }
    int status = -1;
    assert(waitpid(child, &status, 0) == child);
    assert(status == 0);
}

/* At exit, this thread's variables may be gone. */
static void at_exit(void) {
    urdd_robot *robot = NULL;
    assert(urdd_robot_open(NULL, &robot) == URDD_STATUS_POINTER);
    assert(urdd_error_message().length > 0);
    puts("border: answered at exit");
}

int main(int count, char **words) {
    assert(count == 2);
    assert(atexit(at_exit) == 0);
    assert(urdd_abi_version() == URDD_ABI_VERSION);
    nulls();

    urdd_robot *robot = NULL;
    size_t links = 0, dofs = 0;
    ok(urdd_robot_open(words[1], &robot));
    ok(urdd_robot_sizes(robot, &links, NULL, &dofs));
    urdd_text name;
    ok(urdd_robot_link_name(robot, links - 1, &name));
    assert(strlen(name.data) == name.length);
    double *q = malloc(dofs * sizeof *q), *poses = malloc(16 * links * sizeof *poses);
    assert(q != NULL && poses != NULL);
    ok(urdd_robot_zero(robot, q, dofs));
    ok(urdd_robot_link_poses(robot, q, 1, dofs, poses, 16 * links));
    assert(poses[15] == 1.0);
    fails(urdd_robot_link_poses(robot, q, 1, dofs + 1, poses, 16 * links), URDD_STATUS_LENGTH, "values in a row");
    fails(urdd_robot_link(robot, "elbow?", &links), URDD_STATUS_UNKNOWN_NAME, "elbow?");

    urdd_proximity *proximity = NULL;
    ok(urdd_robot_proximity(robot, "hulls", &proximity));
    bool touches = true;
    ok(urdd_proximity_in_collision(proximity, q, 1, dofs, &touches));
    assert(!touches);
    urdd_pair_distance near[2];
    size_t found = 0;
    ok(urdd_proximity_nearest(proximity, q, 1, dofs, 2, near, &found));
    assert(found == 2 && near[0].distance > 0.0 && near[0].distance <= near[1].distance);
    fails(urdd_proximity_is_within(proximity, q, 1, dofs, -0.1, &touches), URDD_STATUS_VALUE, "margin");
    double blocked = 0.0;
    fails(urdd_proximity_blocked_edge(proximity, q, q, 1, dofs, 0.0, -1.0, &blocked), URDD_STATUS_VALUE, "resolution");
    ok(urdd_proximity_free(proximity));

    /* Two spheres about the root, one of them on the last link, which is farther away. */
    const urdd_link_sphere spheres[2] = {{0, 0, {0.0, 0.0, 0.0}, 0.01}, {0, links - 1, {0.0, 0.0, 0.0}, 0.01}};
    const urdd_link_pair pair = {{0, links - 1}};
    const double seen[3] = {0.0, 0.0, 0.005};
    urdd_covering_checker *alone = NULL, *around = NULL;
    urdd_obstacle *cloud = NULL;
    urdd_covering_answer answers[2] = {URDD_COVERING_ANSWER_MAYBE, URDD_COVERING_ANSWER_MAYBE};
    ok(urdd_robot_covering_checker_of(robot, spheres, 2, &pair, 1, &alone));
    ok(urdd_robot_free(robot));
    ok(urdd_obstacle_points("seen", NULL, seen, 1, 0.01, &cloud));
    ok(urdd_covering_checker_around(alone, (const urdd_obstacle *const *)&cloud, 1, &around));
    ok(urdd_obstacle_free(cloud));
    ok(urdd_covering_checker_in_collision(alone, q, 1, dofs, &answers[0]));
    ok(urdd_covering_checker_in_collision(around, q, 1, dofs, &answers[1]));
    assert(answers[0] == URDD_COVERING_ANSWER_FREE && answers[1] == URDD_COVERING_ANSWER_MAYBE);
    ok(urdd_covering_checker_free(alone));
    ok(urdd_covering_checker_free(around));

    urdd_report *report = NULL;
    bool passes = false;
    ok(urdd_validate(words[1], NULL, &report));
    ok(urdd_report_passes(report, &passes));
    assert(passes);
    ok(urdd_report_json(report, &name));
    assert(name.length > 0 && name.data[0] == '{');
    ok(urdd_report_free(report));
    forked(words[1]);
    free(q);
    free(poses);
    puts("border: ok");
    return 0;
}
