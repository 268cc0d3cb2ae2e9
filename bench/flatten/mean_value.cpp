// Mean value coordinates of a disk onto a circle by CGAL: reads an OFF file, prints the seconds of the processor that the map took.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <ctime>
#include <fstream>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace SMP = CGAL::Surface_mesh_parameterization;

int main(int argc, char** argv) {
  Mesh mesh;
  std::ifstream in(argv[argc - 1]);
  if (!(in >> mesh)) return 1;
  auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const std::clock_t start = std::clock();
  using Border = SMP::Circular_border_arc_length_parameterizer_3<Mesh>;
  const auto error = SMP::parameterize(mesh, SMP::Mean_value_coordinates_parameterizer_3<Mesh, Border>(), border, uv);
  std::cout << double(std::clock() - start) / CLOCKS_PER_SEC << '\n';
  return error == SMP::OK ? 0 : 2;
}
