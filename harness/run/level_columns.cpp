#include "harness/run/level_columns.hpp"

#include <map>
#include <set>
#include <string_view>

namespace pairsum::harness {
namespace {

struct level {
  const char* name;
  std::string (*word)(const ranked&);
  bool own;     ///< each backend has its own word, so that it counts only where one backend has several
  bool spoken;  ///< its name belongs to its word: "M 6", but "double"
};

constexpr const char* no_word = "-";

std::string or_none(const std::string& word) { return word.empty() || word == "none" ? no_word : word; }

const level levels[] = {
    {"grid", [](const ranked& r) { return r.what.grid; }, false, false},
    {"M", [](const ranked& r) { return r.what.M > 0 ? std::to_string(r.what.M) : no_word; }, false, true},
    {"threads", [](const ranked& r) { return std::to_string(r.what.threads); }, false, true},
    {"ranks", [](const ranked& r) { return std::to_string(r.what.ranks); }, false, true},
    {"cut", [](const ranked& r) { return or_none(r.what.cut); }, false, true},
    {"precision", [](const ranked& r) { return r.what.precision; }, false, false},
    {"isa", [](const ranked& r) { return r.what.isa; }, true, false},
    {"block", [](const ranked& r) { return or_none(r.what.block); }, true, false},
    {"granularity", [](const ranked& r) { return or_none(r.what.granularity); }, true, false},
    {"build", [](const ranked& r) { return or_none(r.build); }, false, false},
    {"rounds", [](const ranked& r) { return r.step_s.empty() ? no_word : std::to_string(r.step_s.size()); }, false,
     true},
};

/// A single rank is not shown.
bool is_plain(const level& l, const std::string& word) { return std::string_view(l.name) == "ranks" && word == "1"; }

/// The words of the points by backend.
std::map<std::string, std::set<std::string>> words_of_backends(const level& l, const std::vector<ranking>& all) {
  std::map<std::string, std::set<std::string>> words;
  for (const ranking& points : all)
    for (const ranked& r : points) words[r.what.backend].insert(l.word(r));
  return words;
}

}  // namespace

level_columns::level_columns(const std::vector<ranking>& all) {
  for (std::size_t k = 0; k < std::size(levels); ++k) {
    std::set<std::string> words;
    bool backend_has_several = false, some_have_none = false;
    for (auto& [backend, own] : words_of_backends(levels[k], all)) {
      some_have_none = own.erase(no_word) > 0 || some_have_none;
      words.insert(own.begin(), own.end());
      backend_has_several = backend_has_several || own.size() > 1;
    }
    if (levels[k].own ? backend_has_several : words.size() > 1) {
      shown_.push_back(k);
      names_.emplace_back(levels[k].name);
    } else if (words.size() == 1 && !(levels[k].own && some_have_none) && !is_plain(levels[k], *words.begin())) {
      common_ +=
          (common_.empty() ? "" : ", ") + (levels[k].spoken ? std::string(levels[k].name) + " " : "") + *words.begin();
    }
  }
}

std::vector<std::string> level_columns::words_of(const ranked& r) const {
  std::vector<std::string> words;
  for (const std::size_t k : shown_) words.push_back(levels[k].word(r));
  return words;
}

std::string level_columns::name_of(const ranked& r) const {
  std::string name = r.what.backend;
  for (const std::size_t k : shown_) {
    const std::string word = levels[k].word(r);
    if (word == no_word || std::string(levels[k].name) == "rounds") continue;
    name += " " + (levels[k].spoken ? std::string(levels[k].name) + "=" : "") + word;
  }
  return name;
}

}  // namespace pairsum::harness
