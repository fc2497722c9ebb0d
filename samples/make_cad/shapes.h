// The shapes of the samples. Lengths in millimetres; what is true of each shape is in ../README.md.
#pragma once

class TopoDS_Shape;

namespace make_cad {

// Open faces (freeform.cpp)
TopoDS_Shape wave();              ///< (u, v, sin u cos v) on [-3,3]^2: the paper's figure 3
TopoDS_Shape flat();              ///< (u, v, 0) on [-3,3]^2: the Euclidean half of the paper's figure 5
TopoDS_Shape paraboloid();        ///< (u, v, u^2 + v^2) on [-1,1]^2: the paper's figure 4
TopoDS_Shape bumps();             ///< two tall bumps on a plane, [-2,2]^2: the paper's figure 6
TopoDS_Shape freeform();          ///< a bicubic patch of 8 x 8 poles
TopoDS_Shape freeform_refined();  ///< the same points: degree 5 in u, 4 in v, more knots
TopoDS_Shape freeform_swapped();  ///< the same points: u and v exchanged, then u reversed
TopoDS_Shape freeform_moebius();  ///< the same points: rational, u and v warped by Moebius maps
TopoDS_Shape freeform_trimmed();  ///< the same surface with three holes, circles of the parameter plane

// Solids (solids.cpp, bracket.cpp)
TopoDS_Shape cylinder();
TopoDS_Shape cylinder_tube();  ///< the cylinder's wall alone: an open face with a seam
TopoDS_Shape sphere();
TopoDS_Shape torus();
TopoDS_Shape cone();   ///< with its tip
TopoDS_Shape plate();  ///< four bolt holes, a large hole, a slot
TopoDS_Shape bracket();

}  // namespace make_cad
