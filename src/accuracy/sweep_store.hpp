#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "accuracy/ground_truth.hpp"

namespace speculum {

// Measurements of one configuration so far.
struct Measurement {
  std::optional<ErrorFigures> errors;
  std::string drawn;    // fingerprint of the pictures and of the work for them
  std::string picture;  // file in the store's folder
  std::string heatMap;
  std::vector<std::string> frames;  // as picture; of a movement
  std::vector<double> gpuMs;        // one value a round, as in cpuMs and frameMs
  std::vector<double> cpuMs;
  std::vector<double> frameMs;
};

// A sweep's measurements by the fingerprint of all that they depend on, kept in a folder so that an interrupted sweep
// continues. Every write replaces a whole file; a file that cannot be read counts as absent.
class SweepStore {
 public:
  // Creates the folder; throws std::runtime_error if that fails, or if a file of the folder is a link that leads out of
  // it.
  explicit SweepStore(std::filesystem::path folder);

  Measurement& at(const std::string& key) { return measurements_[key]; }
  void save() const;

  std::optional<GroundTruth> truth(const std::string& key) const;
  void keepTruth(const std::string& key, const GroundTruth& truth) const;

  // Writes a picture and returns its file name in the folder.
  std::string keepPicture(const std::string& name, const Image8& image) const;

 private:
  // Returns the path of a file in the folder. Throws FileError for a link that leads out of the folder.
  std::filesystem::path fileNamed(const std::string& name) const;

  std::filesystem::path folder_;
  std::map<std::string, Measurement> measurements_;
};

}  // namespace speculum
