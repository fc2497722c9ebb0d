#include "occ_adapter/occ_private.h"

#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Printer.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <algorithm>
#include <iostream>

namespace geovor::occ {
namespace {

class NullBuffer final : public std::streambuf {
 protected:
  int overflow(int c) override { return traits_type::not_eof(c); }
};

NullBuffer& null_buffer() {
  static NullBuffer buffer;
  return buffer;
}

}  // namespace

// Some of OpenCASCADE's readers write to std::cout past the messenger, so both doors are shut.
Silence::Silence()
    : printers_(Message::DefaultMessenger()->Printers()),
      cout_(std::cout.rdbuf(&null_buffer())),
      cerr_(std::cerr.rdbuf(&null_buffer())) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
}

Silence::~Silence() {
  Message::DefaultMessenger()->ChangePrinters() = printers_;
  std::cout.rdbuf(cout_);
  std::cerr.rdbuf(cerr_);
}

StaticParameter::StaticParameter(const char* name, const std::string& value) : name_(name) {
  const char* old = Interface_Static::CVal(name);
  old_ = old == nullptr ? "" : old;
  Interface_Static::SetCVal(name, value.c_str());
}

StaticParameter::~StaticParameter() { Interface_Static::SetCVal(name_.c_str(), old_.c_str()); }

std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  if (!shape.IsNull()) TopExp::MapShapes(shape, kind, map);
  std::vector<TopoDS_Shape> parts;
  for (int i = 1; i <= map.Extent(); ++i) parts.push_back(map(i));
  return parts;
}

std::string describe(const Standard_Failure& failure) {
  const char* message = failure.GetMessageString();
  std::string text = message != nullptr && *message != '\0' ? message : failure.DynamicType()->Name();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

}  // namespace geovor::occ
