#include "voronoi/cell_areas.h"

#include "voronoi/cell_charts.h"

namespace geovor {

void measure_cells(const Surface& surface, VoronoiDiagram& diagram) {
  const DiagramCharts charts = chart_cells(surface, diagram);
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) diagram.cells[i].area = charts.cells[i].area;
}

}  // namespace geovor
