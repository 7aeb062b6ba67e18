#pragma once
// IGES files for tests: entities in, 80 columns out.
#include <cstdio>
#include <string>
#include <vector>

#include "spline/read_spline.hpp"

namespace firmtouch::spline_test {

struct IgesEntity {
  int type;
  std::string parameters;  // "126,3,..." to the semicolon
  int matrix = 0;          // 1 for the first entity, 3 for the second, ...
  int status = 0;          // 10000: a dependent of another entity
};

constexpr char kMetres[] = "1H,,1H;,1Ht,5Ht.igs,3Hgen,1H1,32,38,6,308,15,1Ht,1.,6,1HM;";

/// A file from its sections' texts, as lines without ends.
class IgesText {
 public:
  explicit IgesText(const std::vector<IgesEntity>& entities, const std::string& global = kMetres) {
    add('S', "made for a test");
    for (size_t at = 0; at < global.size(); at += 72) add('G', global.substr(at, 72));
    std::vector<std::string> parameters;
    char text[100];
    for (size_t e = 0; e < entities.size(); ++e) {
      const IgesEntity& entity = entities[e];
      const size_t first = parameters.size() + 1;
      for (size_t at = 0; at < entity.parameters.size(); at += 64) {
        std::snprintf(text, sizeof(text), "%-64s%8zu", entity.parameters.substr(at, 64).c_str(),
                      2 * e + 1);
        parameters.push_back(text);
      }
      std::snprintf(text, sizeof(text), "%8d%8zu%8d%8d%8d%8d%8d%8d%08d", entity.type, first, 0, 0,
                    0, 0, entity.matrix, 0, entity.status);
      add('D', text);
      std::snprintf(text, sizeof(text), "%8d%8d%8d%8zu%8d", entity.type, 0, 0,
                    parameters.size() + 1 - first, 0);
      add('D', text);
    }
    for (const std::string& line : parameters) add('P', line);
    std::snprintf(text, sizeof(text), "S%7dG%7dD%7dP%7d", counts_[0], counts_[1], counts_[2],
                  counts_[3]);
    add('T', text);
  }

  std::vector<std::string>& lines() { return lines_; }
  std::string text(const char* end = "\n") const {
    std::string all;
    for (const std::string& line : lines_) all += line + end;
    return all;
  }

 private:
  void add(char section, const std::string& columns) {
    const size_t k = std::string("SGDPT").find(section);
    char line[100];
    std::snprintf(line, sizeof(line), "%-72s%c%7d", columns.c_str(), section, ++counts_[k]);
    lines_.push_back(line);
  }
  std::vector<std::string> lines_;
  int counts_[5] = {};
};

/// A cubic of four points: the simplest curve.
inline std::string arch() {
  return "126,3,3,1,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,0.1,0.2,0.,0.2,0.2,0.,0.3,0."
         ",0.,0.,1.,0.,0.,1.;";
}

/// A bilinear surface over 0.1 by 0.2.
inline std::string sheet() {
  return "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,0.1,0.,0.,0.,0.2,0.,"
         "0.1,0.2,0.05,0.,1.,0.,1.;";
}

inline tools::SplineModel read_entities(const std::vector<IgesEntity>& entities) {
  return tools::read_spline_bytes(IgesText(entities).text(), "part.igs", 0);
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Refused, with the file and every part of the message.
inline bool refused(const tools::SplineModel& model, std::initializer_list<const char*> parts) {
  bool good = has(model.problem, "part.") && model.curves.empty() && model.surfaces.empty();
  for (const char* part : parts) good = good && has(model.problem, part);
  if (!good) std::printf("      said: %s\n", model.problem.c_str());
  return good;
}

}  // namespace firmtouch::spline_test
