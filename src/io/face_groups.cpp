#include "io/face_groups.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <set>

namespace geovor {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Bytes of the UTF-8 character at the front of `text`: 0 where there is none (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return follows(1) ? 2 : 0;
  if (first >= 0xe0 && first < 0xf0) {
    const bool in_range = !(first == 0xe0 && second < 0xa0) && !(first == 0xed && second >= 0xa0);
    return in_range && follows(1) && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first < 0xf5) {
    const bool in_range = !(first == 0xf0 && second < 0x90) && !(first == 0xf4 && second >= 0x90);
    return in_range && follows(1) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

char ascii_in(NameAlphabet alphabet, char c) {
  const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  if (control) c = ' ';
  if (alphabet == NameAlphabet::Plain) return is_letter(c) || is_digit(c) || c == '-' ? c : '_';
  if (c == ' ' && alphabet == NameAlphabet::Word) return '_';
  if (c == '"') return '\'';
  return c == '\\' ? '/' : c;
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// A name a face, by the rule of FaceGroup::name.
std::vector<std::string> unique_names(const std::vector<int>& faces, const std::map<int, const FaceLabel*>& labels,
                                      NameAlphabet alphabet, std::size_t longest) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const int face : faces) {
    const auto label = labels.find(face);
    std::string name = label == labels.end() ? "" : name_in(alphabet, label->second->name, longest);
    if (name.empty()) name = "Face" + std::to_string(face);
    ++uses[lower(name)];
    names.push_back(name);
  }
  std::set<std::string> taken;
  for (const std::string& name : names) {
    if (uses[lower(name)] == 1) taken.insert(lower(name));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (uses[lower(names[i])] == 1) continue;
    std::string suffix = "_Face" + std::to_string(faces[i]);
    std::string name = name_in(alphabet, names[i], longest - suffix.size()) + suffix;
    while (!taken.insert(lower(name)).second) {
      suffix += '_';
      name = name_in(alphabet, names[i], longest - suffix.size()) + suffix;
    }
    names[i] = name;
  }
  return names;
}

}  // namespace

std::string name_in(NameAlphabet alphabet, const std::string& text, std::size_t longest) {
  std::string name;
  bool says_something = false;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = utf8_length(rest);
    std::string piece = length > 1 && alphabet != NameAlphabet::Plain ? std::string(rest.substr(0, length))
                        : length == 1                                 ? std::string(1, ascii_in(alphabet, rest.front()))
                        : alphabet == NameAlphabet::Plain             ? "_"
                                                                      : "?";
    rest.remove_prefix(std::max<std::size_t>(length, 1));
    says_something = says_something || piece.size() > 1 || is_letter(piece[0]) || is_digit(piece[0]);
    if (name.empty() && alphabet == NameAlphabet::Plain && !is_letter(piece[0])) name = "N_";
    if (name.size() + piece.size() > longest) break;
    name += piece;
  }
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return says_something ? name : std::string();
}

FaceGroups::FaceGroups(const LabelledMesh& labelled, NameAlphabet alphabet, std::size_t longest) {
  const std::vector<int>& face_of = labelled.mesh.face_of;
  order_.resize(face_of.size());
  std::iota(order_.begin(), order_.end(), 0);
  const auto by_face = [&](int a, int b) { return face_of[a] < face_of[b]; };
  if (!std::is_sorted(face_of.begin(), face_of.end())) std::stable_sort(order_.begin(), order_.end(), by_face);

  std::map<int, const FaceLabel*> labels;
  for (const FaceLabel& label : labelled.labels) labels[label.face] = &label;
  std::vector<int> faces;
  for (std::size_t first = 0; first < order_.size();) {
    std::size_t last = first;
    while (last < order_.size() && face_of[order_[last]] == face_of[order_[first]]) ++last;
    FaceGroup group;
    group.face = face_of[order_[first]];
    group.triangles = std::span<const int>(order_).subspan(first, last - first);
    if (const auto label = labels.find(group.face); label != labels.end()) group.colour = label->second->colour;
    faces.push_back(group.face);
    groups_.push_back(std::move(group));
    first = last;
  }
  const std::vector<std::string> names = unique_names(faces, labels, alphabet, longest);
  for (std::size_t i = 0; i < names.size(); ++i) groups_[i].name = names[i];
}

}  // namespace geovor
