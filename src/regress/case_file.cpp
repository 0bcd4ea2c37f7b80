#include "regress/case_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <stdexcept>
#include <string_view>

#include "accuracy/sweep_planner.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/scene_loader.hpp"
#include "scene/scene_sections.hpp"
#include "scene/text_lines.hpp"
#include "scene/toml_file.hpp"
#include "settings/settings.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;
using Key = std::string_view;

constexpr size_t mostCases = 10000;
constexpr size_t mostBytes = 256 << 20;  // memory of all cases
constexpr size_t longestPath = 65536;    // bytes; no system opens a path that is nearly so long
constexpr size_t longestName = 200;      // bytes of a case's name, which begins the names of files
constexpr Range share{.low = 0.0, .high = 1.0};
constexpr Range seconds{.low = 0.0, .high = 86400.0, .aboveLow = true};

// A table of a case on top of [defaults], before its grid is expanded.
struct Draft {
  RegressCase common;  // what all cases of the table's grid share
  std::optional<std::string> name;
  std::optional<std::string> scene;
  std::string picture = "{name}.png";
  std::map<std::string, std::string> settings;
  std::map<std::string, std::vector<std::string>> grid;
};

size_t bytesOf(const fs::path& path) {
  return path.native().size() + static_cast<size_t>(std::distance(path.begin(), path.end())) * sizeof path;
}

size_t bytesOf(const RegressCase& subject) {
  size_t bytes = sizeof subject + 3 * subject.name.size() + subject.camera.value_or("").size() +
                 subject.cameraPlace.size() + bytesOf(subject.scene) + bytesOf(subject.picture) +
                 bytesOf(subject.mask.value_or(""));
  for (const Expectation& entry : subject.expect) {
    bytes += sizeof entry + entry.driver.size() + entry.version.value_or("").size() + entry.reason.size() +
             bytesOf(entry.picture.value_or(""));
  }
  return bytes;
}

std::optional<std::string> textIn(const TableReader& table, Key key, const char* right = "a string is needed") {
  if (!table.has(key)) {
    return std::nullopt;
  }
  std::string value = table.textAs(key, right);
  if (value.empty()) {
    table.fail(key, "is empty", "a text is needed");
  }
  return value;
}

Tolerance readTolerance(const TableReader& table) {
  static constexpr std::array<Key, 5> keys{"max_diff", "share", "block", "flip", "flip_p99"};
  Tolerance tolerance;
  if (const std::optional<TableReader> bounds = table.subtable("tolerance", keys)) {
    const auto fraction = [&](Key key) {
      return bounds->has(key) ? std::optional(bounds->number(key, share)) : std::nullopt;
    };
    if (bounds->has("max_diff")) {
      tolerance.maxDiff = static_cast<int>(bounds->integer("max_diff", {.low = 0, .high = 255}));
    }
    if (bounds->has("block")) {
      tolerance.block = bounds->boolean("block");
    }
    tolerance.share = fraction("share");
    tolerance.flip = fraction("flip");
    tolerance.flipP99 = fraction("flip_p99");
  }
  return tolerance;
}

// Returns the name of expected pictures that a table gives, in which {name} stands for a case's.
std::optional<std::string> pictureIn(const TableReader& table) {
  const std::optional<std::string> pattern = textIn(table, "picture");
  if (pattern && pattern->size() > longestPath) {
    table.fail("picture", "has more than 65536 bytes", "a shorter path is needed");
  }
  std::string rest = pattern.value_or("");
  for (size_t at = 0; (at = rest.find("{name}", at)) != std::string::npos;) {
    rest.erase(at, std::string_view("{name}").size());
  }
  if (pattern &&
      (rest.find_first_of("{}") != std::string::npos || lowerCase(fs::path(*pattern).extension().string()) != ".png")) {
    table.fail("picture", fmt::format("is '{}'", *pattern), "a PNG file is needed, such as \"{name}.png\"");
  }
  return pattern;
}

std::vector<Expectation> readExpectations(const TableReader& table) {
  static constexpr std::array<Key, 6> keys{"driver", "version", "result", "reason", "picture", "tolerance"};
  static constexpr std::array<Key, 3> results{"pass", "fail", "skip"};
  std::vector<Expectation> expectations;
  for (const TableReader& entry : table.tables("expect", keys)) {
    Expectation expectation{.driver = entry.text("driver"), .version = textIn(entry, "version")};
    if (expectation.version) {
      try {
        isInVersions("", *expectation.version);
      } catch (const std::invalid_argument& error) {
        entry.fail("version", error.what(), "comparisons such as \">=25,<26\" are needed");
      }
    }
    if (entry.has("result")) {
      expectation.result = static_cast<ExpectedResult>(entry.choice("result", results));
    }
    expectation.reason = entry.text("reason", "");
    if (expectation.result != ExpectedResult::pass && expectation.reason.empty()) {
      entry.fail("reason", "is missing", "a sentence that says why is needed");
    }
    expectation.picture = pictureIn(entry);
    expectation.tolerance = readTolerance(entry);
    expectations.push_back(std::move(expectation));
  }
  return expectations;
}

// Returns a name for files made of a case's: all but letters, digits, ._=+-, and visible characters beyond ASCII
// becomes an underscore.
std::string nameOfFiles(std::string_view name) {
  std::string files;
  for (size_t at = 0, bytes = 0; at < name.size(); at += bytes) {
    for (bytes = 1; at + bytes < name.size() && continuesCharacter(name[at + bytes]);) {
      ++bytes;
    }
    const std::string_view character = name.substr(at, bytes);
    const bool plain = std::isalnum(static_cast<unsigned char>(name[at])) != 0 ||
                       std::string_view("._=+-,").find(name[at]) != std::string_view::npos;
    files += plain || (bytes > 1 && oneLine(character) == character) ? character : "_";
  }
  return files;
}

// Reads the cases of one file.
class CaseReader {
 public:
  explicit CaseReader(const fs::path& file) : file_(file) {}

  void read(const TableReader& table, Draft& draft) const {
    draft.common.line = table.line();
    if (const auto name = textIn(table, "name")) {
      draft.name = name;
    }
    for (const auto& [key, right] : {std::pair("scene", "a file or a name of speculum scenes is needed"),
                                     std::pair("camera", "a string as --camera takes it is needed"),
                                     std::pair("size", "a string such as \"640x360\" is needed")}) {
      if (const auto value = textIn(table, key, right)) {
        apply(table, draft, key, *value);
      }
    }
    draft.common.time = table.number("time", draft.common.time, timeRange);
    draft.common.timeout = table.number("timeout", draft.common.timeout, seconds);
    draft.common.strict = table.has("strict") ? table.boolean("strict") : draft.common.strict;
    if (const auto mask = textIn(table, "mask")) {
      draft.common.mask = mask->size() <= longestPath ? beside(*mask) : fs::path();
      if (!isFile(*draft.common.mask)) {
        table.fail("mask", "is '" + *mask + "'", "a PNG file is needed");
      }
    }
    draft.picture = pictureIn(table).value_or(draft.picture);
    // settingsOf() knows what each setting takes; its error names file and line.
    Scene settings;
    settings.file = file_;
    settings.settings = readSettings(table);
    const Settings checked = settingsOf(settings);
    for (const SettingEntry& entry : settings.settings) {
      draft.settings[entry.key] = settingValue(checked, entry.key);
    }
    if (const std::optional<TableReader> grid = table.subtable("grid")) {
      for (const auto& [key, node] : grid->table()) {
        const std::string name(key.str());
        draft.grid[name] = settingTexts(*grid, name, node);
        for (const std::string& value : draft.grid[name]) {
          Draft scratch;
          apply(*grid, scratch, name, value);
        }
      }
    }
    draft.common.tolerance = merged(draft.common.tolerance, readTolerance(table));
    if (table.has("expect")) {
      draft.common.expect = readExpectations(table);
    }
  }

  void expand(const TableReader& table, const Draft& draft, std::vector<RegressCase>& cases) {
    const auto all =
        combinations({draft.grid.begin(), draft.grid.end()}, mostCases - std::min(mostCases, cases.size()));
    if (!all) {
      table.fail("grid", "makes more than " + std::to_string(mostCases) + " cases", "fewer are needed");
    }
    for (const std::vector<SettingChange>& combination : *all) {
      Draft one = draft;
      std::string suffix;
      for (const auto& [key, value] : combination) {
        suffix += key == "scene" && !draft.name ? "" : "_" + key + "=" + value;
        apply(table, one, key, value);
      }
      add(table, one, suffix, cases);
    }
  }

 private:
  fs::path beside(const std::string& path) const { return (file_.parent_path() / path).lexically_normal(); }

  // Sets what a grid may vary: a key of the case that is a text or a number, or else a setting.
  void apply(const TableReader& table, Draft& draft, const std::string& key, const std::string& value) const {
    if (key == "scene") {
      draft.scene = value;
      const fs::path named = value.size() <= longestPath ? beside(value) : fs::path();
      const std::optional<fs::path> shipped = isFile(named) || named.empty() ? std::nullopt : shippedScene(value);
      draft.common.scene = shipped.value_or(named);
      if (!isFile(draft.common.scene)) {
        table.fail(key, "is '" + value + "'", "a file beside this one, or a name of speculum scenes, is needed");
      }
    } else if (key == "camera") {
      try {
        if (meansPoints(value)) {
          parseCamera(value);
        }
      } catch (const std::invalid_argument& error) {
        table.fail(key, error.what(), "as --camera takes it");
      }
      draft.common.camera = value;
      draft.common.cameraPlace = table.place(table.has(key) ? key : "grid");
    } else if (key == "size") {
      const std::optional<PictureSize> size = pictureSize(value);
      if (!size) {
        table.fail(key, "is '" + value + "'", std::string(pictureSizes) + " is needed");
      }
      draft.common.size = *size;
    } else if (key == "time") {
      const char* start = value.c_str();
      char* end = nullptr;
      draft.common.time = std::strtod(start, &end);
      if (end == start || *end != '\0' || !timeRange.contains(draft.common.time)) {
        table.fail(key, "is '" + value + "'", timeRange.text());
      }
    } else {
      Settings scratch;
      if (const auto problem = setSetting(scratch, key, value)) {
        table.fail(key, *problem, "keys and values as --set takes them are needed");
      }
      draft.settings[key] = value;
    }
  }

  void add(const TableReader& table, const Draft& draft, const std::string& suffix, std::vector<RegressCase>& cases) {
    RegressCase made = draft.common;
    if (!draft.scene) {
      table.fail("scene", "is missing", "a scene file, or a name of speculum scenes, is needed");
    }
    const std::string written = draft.name.value_or(fs::path(*draft.scene).stem().string()) + suffix;
    made.name = nameOfFiles(written);
    if (made.name.size() > longestName) {
      table.fail(draft.grid.empty() ? "name" : "grid", "makes names of more than 200 bytes", "shorter ones are needed");
    }
    if (const auto [earlier, isNew] = names_.try_emplace(lowerCase(made.name), written, made.line); !isNew) {
      const auto& [name, line] = earlier->second;
      table.fail(line == made.line && !draft.grid.empty() ? "grid" : "name",
                 name == written
                     ? fmt::format("'{}' is already the name of an earlier case", written)
                     : fmt::format("'{}' and an earlier case, '{}', would both have files called '{}'{}", written, name,
                                   made.name, nameOfFiles(name) == made.name ? "" : " where case does not count"),
                 "names must be unique");
    }
    made.settings.assign(draft.settings.begin(), draft.settings.end());
    Settings settings;
    for (const auto& [key, value] : made.settings) {
      setSetting(settings, key, value);
    }
    if (settings.quality.budgetMs > 0.0 || settings.quality.maxError > 0.0) {
      table.fail("settings", "quality.budget_ms and quality.max_error choose from a sweep", "cases have none");
    }
    size_t bytes = bytes_;
    const auto pictureFile = [&](const std::string& pattern) {
      constexpr std::string_view placeholder = "{name}";
      std::string path;
      for (size_t at = 0; at < pattern.size() && path.size() <= longestPath; at += placeholder.size()) {
        const size_t next = std::min(pattern.find(placeholder, at), pattern.size());
        path.append(pattern, at, next - at).append(next < pattern.size() ? made.name : "");
        at = next;
      }
      if (path.size() > longestPath) {
        table.fail("picture", "has more than 65536 bytes with the case's name", "a shorter path is needed");
      }
      requireRoom(table, bytes += path.size() + static_cast<size_t>(std::ranges::count(path, '/')) * sizeof(fs::path));
      return beside(path);
    };
    made.picture = pictureFile(draft.picture);
    for (Expectation& expectation : made.expect) {
      if (expectation.picture) {
        expectation.picture = pictureFile(expectation.picture->string());
      }
    }
    bytes_ += bytesOf(made);
    requireRoom(table, bytes_);
    cases.push_back(std::move(made));
  }

  static void requireRoom(const TableReader& table, size_t bytes) {
    if (bytes > mostBytes) {
      table.fail("grid", "makes cases of more than 256 MiB", "fewer cases, expectations or shorter texts are needed");
    }
  }

  const fs::path& file_;
  std::map<std::string, std::pair<std::string, int>>
      names_;         // by the name of files in lower case: as written, line of the table
  size_t bytes_ = 0;  // of the cases
};

constexpr std::string_view digitsAndDots = "0123456789.";

// Returns the parts of a dotted number; nothing for any other text.
std::vector<int> partsOf(std::string_view text) {
  std::vector<int> parts;
  const bool plain = text.find_first_not_of(digitsAndDots) == std::string_view::npos;  // from_chars takes a sign too
  for (const char* at = text.data(); plain; ++at) {
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), parts.emplace_back());
    if (error != std::errc()) {
      break;
    }
    if (end == text.data() + text.size()) {
      return parts;
    }
    at = end;
  }
  return {};
}

// Returns the parts of the first number of a driver's text that has a dot.
std::vector<int> versionOf(std::string_view driver) {
  for (size_t at = 0, end = 0; (at = driver.find_first_of(digitsAndDots, end)) != std::string_view::npos;) {
    end = std::min(driver.find_first_not_of(digitsAndDots, at), driver.size());
    if (std::vector<int> parts = partsOf(driver.substr(at, end - at)); parts.size() > 1) {
      return parts;
    }
  }
  return {};
}

}  // namespace

Tolerance merged(const Tolerance& base, const Tolerance& changes) {
  return {.maxDiff = changes.maxDiff ? changes.maxDiff : base.maxDiff,
          .share = changes.share ? changes.share : base.share,
          .block = changes.block ? changes.block : base.block,
          .flip = changes.flip ? changes.flip : base.flip,
          .flipP99 = changes.flipP99 ? changes.flipP99 : base.flipP99};
}

ExpectedCase expectedOf(const RegressCase& subject, const std::string& driver) {
  ExpectedCase expected{.subject = subject};
  for (const Expectation& entry : subject.expect) {
    if (isOfFamily(driver, entry.driver) && (!entry.version || isInVersions(driver, *entry.version))) {
      expected.result = entry.result;
      expected.reason = entry.reason;
      expected.subject.picture = entry.picture.value_or(subject.picture);
      expected.subject.tolerance = merged(subject.tolerance, entry.tolerance);
      break;
    }
  }
  return expected;
}

std::vector<RegressCase> readCases(const fs::path& file) {
  static constexpr std::array<Key, 2> rootKeys{"defaults", "case"};
  static constexpr std::array<Key, 13> keys{"scene", "name",    "time",    "camera",    "size",   "settings", "grid",
                                            "mask",  "timeout", "picture", "tolerance", "expect", "strict"};
  const toml::table root = readToml(file, "file of cases");
  const TableReader reader(file, "", root, 1, rootKeys);
  CaseReader cases(file);
  Draft defaults;
  defaults.common.size = {640, 360};
  defaults.common.timeout = 60.0;
  defaults.common.tolerance = {.maxDiff = 3, .share = 0.001, .block = true};
  if (const std::optional<TableReader> table = reader.subtable("defaults", keys)) {
    cases.read(*table, defaults);
  }
  std::vector<RegressCase> read;
  for (const TableReader& table : reader.tables("case", keys)) {
    Draft draft = defaults;
    cases.read(table, draft);
    cases.expand(table, draft, read);
  }
  if (read.empty()) {
    reader.fail("case", "is missing", "write [[case]] above each case");
  }
  return read;
}

bool isOfFamily(const std::string& driver, const std::string& family) {
  const std::string word = lowerCase(family);
  return lowerCase(driver).find(word == "lavapipe" ? "llvmpipe" : word) != std::string::npos;
}

bool isInVersions(const std::string& driver, const std::string& range) {
  const std::vector<int> version = versionOf(driver);
  bool holds = !version.empty();
  for (size_t at = 0; at <= range.size();) {
    const size_t end = std::min(range.find(',', at), range.size());
    const std::string_view text = trimmed(std::string_view(range).substr(at, end - at));
    at = end + 1;
    const std::string_view sign = text.substr(0, text.starts_with(">=") || text.starts_with("<=") ? 2 : 1);
    const std::vector<int> bound = partsOf(trimmed(text.substr(sign.size())));
    if (sign.find_first_of("<>=") != 0 || bound.empty()) {
      throw std::invalid_argument("'" + range + "' is no range");
    }
    std::vector<int> own = version;
    own.resize(bound.size());
    holds &= (sign.ends_with('=') && own == bound) || (sign.front() == '>' && own > bound) ||
             (sign.front() == '<' && own < bound);
  }
  return holds;
}

}  // namespace speculum
