#pragma once
#include <filesystem>
#include <functional>

#include <pairsum/sum/registry.hpp>
#include "harness/run/job_launch.hpp"
#include "harness/run/order.hpp"

namespace pairsum::harness {

/// Has an order carried out and waits for its end.
using launcher = std::function<departure(const order&)>;

/// In a fresh process of this program or of another build of it: address space, thread pools and memory are new. The
/// process dies with this one; SIGINT and SIGTERM are handed on to it. Throws pairsum::error if `program` cannot be
/// run.
/// @param of_jobs what starts an order of several ranks, see run_job(); they are of this program
launcher in_a_process(const std::filesystem::path& program, const std::string& of_jobs = default_launcher);

/// Says to the process that handed the order over, through its descriptor, that the work came to its end with this
/// code. No library that ends the process can say it.
void say_done(int order_descriptor, int code);

/// In this process, with backends of the caller's choice.
launcher in_this_process(const registry& all);

/// The path of the running program.
std::filesystem::path this_program();
/// The word with which it was called.
std::string called_as();

/// A word as a shell reads it, quoted where it must be.
std::string shell_word(const std::string& word);

}  // namespace pairsum::harness
