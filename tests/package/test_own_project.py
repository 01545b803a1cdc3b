"""A project whose files are named like the library's, and whose shared library holds it."""

from conftest import call, must

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(mine LANGUAGES CXX)
find_package(pairsum 0.1 REQUIRED)
add_library(mine SHARED mine.cpp)
target_include_directories(mine PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(mine PRIVATE pairsum::pairsum)
add_executable(main main.cpp)
target_link_libraries(main PRIVATE mine)
"""
OWN_HEADER = """#pragma once
#define MINE 1
struct vec { int is_mine = 1; };
"""
LIBRARY = """#include "core/vec.hpp"
#include <pairsum/pairsum.hpp>
#include "sum/registry.hpp"

std::size_t number_of_backends() {
  static_assert(MINE == 1);
  vec both;
  return both.is_mine == 1 ? pairsum::registry::instance().backends().size() : 0;
}
"""
MAIN = """#include <cstddef>
#include <cstdio>
std::size_t number_of_backends();
int main() { std::printf("%zu", number_of_backends()); }
"""


def test_own_headers_and_a_shared_library(project, built, tmp_path):
    folder = tmp_path / "mine"
    for name, text in {"CMakeLists.txt": PROJECT, "core/vec.hpp": OWN_HEADER, "sum/registry.hpp": "#pragma once\n", "mine.cpp": LIBRARY,
                       "main.cpp": MAIN}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    build, configured = project(folder)
    assert configured.returncode == 0, configured.stdout
    must("cmake", "--build", build)
    done = call(build / "main")
    assert (done.returncode, done.stdout) == (0, str(len(built("BACKENDS"))))
