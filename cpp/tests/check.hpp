// What the tests of the C++ interface share.

#ifndef URDD_TESTS_CHECK_HPP
#define URDD_TESTS_CHECK_HPP

#include <cstdio>
#include <cstdlib>
#include <string>
#include <urdd.hpp>

#define CHECK(condition)                                                                                               \
    if (!(condition)) {                                                                                                \
        std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                           \
        std::exit(1);                                                                                                  \
    }

/// The status of the error that this throws, which has a message; `OK` if it throws none.
template <typename F> urdd_status thrown(F &&act) {
    try {
        act();
    } catch (const urdd::Error &error) {
        CHECK(std::string(error.what()).size() > 5);
        return error.status();
    }
    return URDD_STATUS_OK;
}

#endif
