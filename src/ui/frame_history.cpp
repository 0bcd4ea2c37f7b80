#include "ui/frame_history.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/image_metrics.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string field(double ms) {
  return std::isnan(ms) ? "" : fmt::format("{:.4f}", ms);
}

double passOf(const std::vector<double>& passes, size_t name) {
  return name < passes.size() ? passes[name] : unknown;
}

}  // namespace

void FrameHistory::add(uint64_t number, double frameMs, double cpuMs, bool lowered) {
  if (paused_) {
    return;
  }
  lowered_ = lowered;
  std::deque<Row>& rows = rows_[static_cast<size_t>(lowered)];
  rows.push_back({number, {frameMs, cpuMs, unknown}, {}});
  if (rows.size() > longest) {
    rows.pop_front();
  }
}

void FrameHistory::addGpu(uint64_t number, double gpuMs, std::span<const std::pair<std::string, double>> passes) {
  Row* row = nullptr;
  for (std::deque<Row>& rows : rows_) {
    const auto found = std::ranges::find(rows, number, &Row::number);
    row = found != rows.end() ? &*found : row;
  }
  if (paused_ || !row || !std::isnan(row->ms.back())) {
    return;
  }
  row->ms.back() = gpuMs;
  for (const auto& [name, ms] : passes) {
    const size_t index = std::ranges::find(names_, name) - names_.begin();
    if (index == names_.size()) {
      names_.push_back(name);
    }
    row->passes.resize(std::max(row->passes.size(), index + 1), unknown);
    double& sum = row->passes[index];
    sum = std::isnan(sum) ? ms : sum + ms;
  }
}

void FrameHistory::clear() {
  rows_ = {};
  names_.clear();
}

void FrameHistory::restart() {
  restarts_ = true;
  setPaused(paused_);
}

void FrameHistory::setPaused(bool paused) {
  paused_ = paused;
  if (!paused_ && std::exchange(restarts_, false)) {
    clear();
  }
}

std::vector<float> FrameHistory::series(Figure figure) const {
  std::vector<float> values;
  for (const Row& row : rows()) {
    values.push_back(static_cast<float>(row.ms[static_cast<size_t>(figure)]));
  }
  return values;
}

std::vector<std::string> FrameHistory::passNames() const {
  std::vector<const Row*> timed;  // newest first
  for (auto row = rows().rbegin(); row != rows().rend() && timed.size() < recent; ++row) {
    if (!row->passes.empty()) {
      timed.push_back(&*row);
    }
  }
  std::vector<std::string> present;
  for (size_t i = 0; i < names_.size(); ++i) {
    if (std::ranges::any_of(timed, [&](const Row* row) { return !std::isnan(passOf(row->passes, i)); })) {
      present.push_back(names_[i]);
    }
  }
  return present;
}

std::vector<float> FrameHistory::passSeries(const std::string& pass) const {
  const size_t index = std::ranges::find(names_, pass) - names_.begin();
  std::vector<float> values;
  for (const Row& row : rows()) {
    values.push_back(static_cast<float>(passOf(row.passes, index)));
  }
  return values;
}

std::vector<float> FrameHistory::filledSeries(const std::string& pass) const {
  std::vector<float> values = passSeries(pass);
  for (size_t i = 1; i < values.size(); ++i) {
    values[i] = std::isnan(values[i]) ? values[i - 1] : values[i];
  }
  return values;
}

std::string FrameHistory::csv() const {
  std::string text = "frame,frame ms,CPU ms,GPU ms";
  for (const std::string& name : names_) {
    text += "," + csvField(name + " ms");
  }
  for (const Row& row : rows()) {
    text += fmt::format("\n{},{},{},{}", row.number, field(row.ms[0]), field(row.ms[1]), field(row.ms[2]));
    for (size_t column = 0; column < names_.size(); ++column) {
      text += "," + field(passOf(row.passes, column));
    }
  }
  return text + "\n";
}

double percentile(std::span<const float> values, double share) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known), [](float v) { return !std::isnan(v); });
  return known.empty() ? unknown : nearestRank(std::move(known), share);
}

}  // namespace speculum
