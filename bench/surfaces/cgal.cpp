// CGAL's isotropic remeshing and edge collapse, for compare.py:
//   cgal remesh IN.obj LENGTH ITERATIONS OUT.obj
//   cgal simplify IN.obj FACES OUT.obj
// Prints the seconds of processor time and of the clock that the operation alone took.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int count, char** words) {
    const std::string task = count > 1 ? words[1] : "";
    if (!(task == "remesh" && count == 6) && !(task == "simplify" && count == 5)) {
        std::fprintf(stderr, "usage: cgal remesh IN LENGTH ITERATIONS OUT | cgal simplify IN FACES OUT\n");
        return 2;
    }
    Mesh mesh;
    if (!CGAL::IO::read_polygon_mesh(words[2], mesh)) {
        std::fprintf(stderr, "%s: cannot be read\n", words[2]);
        return 1;
    }
    const std::clock_t cpu = std::clock();
    const auto clock = std::chrono::steady_clock::now();
    if (task == "remesh") {
        namespace pmp = CGAL::Polygon_mesh_processing;
        pmp::isotropic_remeshing(faces(mesh), std::atof(words[3]), mesh,
                                 CGAL::parameters::number_of_iterations(std::atoi(words[4])));
    } else {
        // Of a closed surface: three edges for two faces.
        namespace sms = CGAL::Surface_mesh_simplification;
        sms::Count_stop_predicate<Mesh> stop(std::atol(words[3]) * 3 / 2);
        sms::edge_collapse(mesh, stop);
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - clock;
    std::printf("%.6f %.6f\n", double(std::clock() - cpu) / CLOCKS_PER_SEC, wall.count());
    mesh.collect_garbage();
    return CGAL::IO::write_polygon_mesh(words[count - 1], mesh, CGAL::parameters::stream_precision(17)) ? 0 : 1;
}
