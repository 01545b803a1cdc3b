#include "harness/run/launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include <pairsum/core/error.hpp>
#include "harness/measure/cpu_time.hpp"
#include "harness/run/child.hpp"
#include "harness/run/job_launch.hpp"
#include "harness/run/worker.hpp"
#include "harness/terminal/program.hpp"

namespace pairsum::harness {
namespace {

/// Behind the order: the code with which its work was done, as text.
constexpr std::string_view mark = "\ndone ";

/// The code with which the work of an order of `size` bytes was done.
std::optional<int> code_when_done(int file, std::size_t size) {
  char text[32]{};
  const ssize_t n = ::pread(file, text, sizeof text - 1, static_cast<off_t>(size));
  if (n <= 0 || !std::string_view(text).starts_with(mark)) return std::nullopt;
  return std::atoi(text + mark.size());
}

void become(const std::string& program, const std::string& descriptor, int file, int store) {
  ::fcntl(file, F_SETFD, 0);
  if (store >= 0) ::fcntl(store, F_SETFD, 0);
  ::execl(program.c_str(), program.c_str(), "worker", descriptor.c_str(), static_cast<char*>(nullptr));
}

departure in_one_process(const std::string& name, const order& o) {
  const std::string text = order_json(o).dump();
  const int file = file_of("pairsum-order", text);
  const std::string descriptor = std::to_string(file);
  departure end = wait_for(start_child(SIGKILL, [&] { become(name, descriptor, file, o.store); }));
  const std::optional<int> code = code_when_done(file, text.size());
  ::close(file);
  end.done = code.has_value();
  if (code && end.signal == 0) end.code = *code;
  if (end.code == cannot_run) throw error(fmt::format("{} is no program that can be run", name));
  return end;
}

}  // namespace

std::filesystem::path this_program() {
  return "/proc/self/exe";  // which stays this program, even if its file is replaced
}

std::string called_as() {
  std::string word;
  std::getline(std::ifstream("/proc/self/cmdline"), word, '\0');
  return word.empty() ? "pairsum" : word;
}

std::string shell_word(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:,=+@%-";
  if (!word.empty() && word.find_first_not_of(plain) == word.npos) return word;
  const auto is_plain = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
  };
  if (one_line(word) != word) {
    std::string escaped = "$'";
    for (const char c : word)
      escaped += !is_plain(c)             ? fmt::format("\\{:03o}", static_cast<unsigned char>(c))
                 : c == '\'' || c == '\\' ? fmt::format("\\{}", c)
                                          : std::string(1, c);
    return escaped + "'";
  }
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

launcher in_a_process(const std::filesystem::path& program, const std::string& of_jobs) {
  if (::access(program.c_str(), X_OK) != 0 || std::filesystem::is_directory(program))
    throw error(fmt::format("{} is no program that can be run", program.string()));
  return [name = program.string(), of_jobs](const order& o) {
    if (o.ranks == 1) return in_one_process(name, o);
    return run_job(of_jobs, name, o.ranks, {"worker", "-1"}, order_json(o).dump(), o.crowded);
  };
}

void say_done(int order_descriptor, int code) {
  const std::string text = std::string(mark) + std::to_string(code);
  const off_t end = ::lseek(order_descriptor, 0, SEEK_END);
  if (end < 0 || ::pwrite(order_descriptor, text.data(), text.size(), end) != static_cast<ssize_t>(text.size()))
    throw error(fmt::format("cannot say that the work is done: {}", std::strerror(errno)));
}

launcher in_this_process(const registry& all) {
  return [&all](const order& o) {
    const double before = own_time();
    departure end;
    end.code = carry_out(o, all);
    end.cpu_s = own_time() - before;
    end.done = true;
    return end;
  };
}

}  // namespace pairsum::harness
