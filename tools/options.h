// The command line: what each command was asked to do.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/face_point.h"
#include "progress.h"

namespace geovor {

struct InfoArguments {
  std::string input;
  bool json = false;
};

enum class StepForm {
  Faceted,      ///< a planar face a triangle: any CAD system reads it
  Tessellated,  ///< AP242's triangulated faces: short, for systems that know them
};

struct MeshArguments {
  std::string input;
  std::vector<std::string> outputs;
  double size = 0.0;                                            ///< model units
  double min_size = 0.0;                                        ///< model units; 0: the mesher's choice
  double deflection = std::numeric_limits<double>::infinity();  ///< model units
  double angle = 15.0;                                          ///< degrees
  double gradation = 0.5;
  std::string sizes;       ///< path of a CSV file with rules of single faces, empty: none
  std::vector<int> faces;  ///< empty: all
  int threads = 0;         ///< 0: all cores
  std::string report;      ///< path, empty: none
  ProgressWish progress = ProgressWish::WhereTerminal;
  StepForm step_form = StepForm::Faceted;
  bool ascii = false;   ///< .stl as text
  bool strict = false;  ///< write nothing unless every face was meshed
};

struct VoronoiArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::optional<int> face;
  std::string sites;     ///< path of a CSV file, empty: none
  int count = 0;         ///< sites to place; 0: none
  double spacing = 0.0;  ///< model units between sites to place; 0: none
  std::uint64_t seed = 0;
  bool snap = false;     ///< sites off the face are moved onto it
  bool certify = false;  ///< check the star certificate on the finished diagram
  ProgressWish progress = ProgressWish::WhereTerminal;
};

struct DistanceArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::optional<int> face;
  std::string from_text, to_text;  ///< as the user wrote them, for messages
  FacePoint from, to;
  bool snap = false;  ///< points off the face are moved onto it
};

struct CheckArguments {
  std::string mesh;
  std::string against;  ///< CAD file
  std::vector<std::string> outputs;
  int threads = 0;  ///< 0: all cores
  bool json = false;
};

/// Nothing left to do: the help or the version was printed.
struct NoArguments {};

using CommandLine =
    std::variant<NoArguments, InfoArguments, MeshArguments, VoronoiArguments, DistanceArguments, CheckArguments>;

/// Prints the help or the version on stdout where these are asked for. Throws Error(Usage), with one line that ends in
/// where to read more.
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace geovor
