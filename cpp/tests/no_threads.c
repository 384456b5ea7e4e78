/* Where no thread can be started, every call is answered on the calling thread. */

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <urdd.h>

#undef NDEBUG
#include <assert.h>

/* What the library finds in place of the system's: as where `ulimit -u` is reached. */
static int asked = 0;
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument) {
    (void)thread, (void)attributes, (void)run, (void)argument;
    ++asked;
    return EAGAIN;
}

static void ok(urdd_status status) {
    if (status != URDD_STATUS_OK) {
        fprintf(stderr, "%d: %s\n", (int)status, urdd_error_message().data);
        abort();
    }
}

int main(int count, char **words) {
    enum { ROWS = 200 };
    assert(count == 2);
    urdd_robot *robot = NULL;
    urdd_proximity *proximity = NULL;
    urdd_report *report = NULL;
    size_t dofs = 0, apart = 0;
    bool touches[ROWS], passes = false;
    ok(urdd_robot_open(words[1], &robot));
    ok(urdd_robot_sizes(robot, NULL, NULL, &dofs));
    double *q = malloc(ROWS * dofs * sizeof *q);
    assert(q != NULL);
    ok(urdd_robot_random(robot, 0, q, ROWS, dofs));
    ok(urdd_robot_proximity(robot, "pieces", &proximity));
    ok(urdd_proximity_in_collision(proximity, q, ROWS, dofs, touches));
    for (size_t k = 0; k < ROWS; ++k) {
        bool touching = false;
        ok(urdd_proximity_in_collision(proximity, q + k * dofs, 1, dofs, &touching));
        assert(touching == touches[k]);
        apart += !touching;
    }
    assert(apart > 0 && apart < ROWS);
    ok(urdd_validate(words[1], NULL, &report));
    ok(urdd_report_passes(report, &passes));
    assert(passes && asked > 0);
    ok(urdd_report_free(report));
    ok(urdd_proximity_free(proximity));
    ok(urdd_robot_free(robot));
    free(q);
    puts("no_threads: ok");
    return 0;
}
