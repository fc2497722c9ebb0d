#include "voronoi/cell_areas.h"

#include "voronoi/cell_charts.h"

namespace geovor {

void measure_cells(const FaceDomain& domain, VoronoiDiagram& diagram) {
  const DiagramCharts charts = chart_cells(domain, diagram);
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) diagram.cells[i].area = charts.cells[i].area;
}

}  // namespace geovor
