// Directed distances of CGAL's Polygon_mesh_processing, asked for line by line on standard input.
//
//   hausdorff bounded|sampled A.arrays B.arrays TOLERANCE SAMPLES
//
// Meshes are read and made into CGAL's own before the first answer. Every line that comes in is answered with one JSON
// object: the value, wall and CPU time of the call, and its memory. The files are those of arrays.py.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

static Mesh read_mesh(const char *path) {
    std::ifstream file(path, std::ios::binary);
    std::int64_t counts[2];
    if (!file.read(reinterpret_cast<char *>(counts), sizeof counts)) throw std::runtime_error("cannot read the arrays");
    std::vector<std::array<double, 3>> coordinates(counts[0]);
    std::vector<std::array<std::int32_t, 3>> indices(counts[1]);
    file.read(reinterpret_cast<char *>(coordinates.data()), counts[0] * sizeof coordinates[0]);
    file.read(reinterpret_cast<char *>(indices.data()), counts[1] * sizeof indices[0]);

    std::vector<Kernel::Point_3> points;
    for (const auto &p : coordinates) points.emplace_back(p[0], p[1], p[2]);
    std::vector<std::vector<std::size_t>> faces;
    for (const auto &f : indices) faces.push_back({std::size_t(f[0]), std::size_t(f[1]), std::size_t(f[2])});
    PMP::orient_polygon_soup(points, faces);
    Mesh mesh;
    if (PMP::is_polygon_soup_a_polygon_mesh(faces)) {
        PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
    } else {
        // What CGAL's mesh cannot hold otherwise, it holds as faces that share nothing.
        for (const auto &f : faces)
            mesh.add_face(mesh.add_vertex(points[f[0]]), mesh.add_vertex(points[f[1]]), mesh.add_vertex(points[f[2]]));
    }
    return mesh;
}

// A figure of /proc/self/status in MiB.
static double status_mib(const std::string &key) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.rfind(key, 0) == 0) return std::atof(line.c_str() + key.size() + 1) / 1024;
    return 0;
}

int main(int argc, char **argv) try {
    if (argc != 6) throw std::runtime_error("hausdorff bounded|sampled A.arrays B.arrays TOLERANCE SAMPLES");
    const bool bounded = std::string(argv[1]) == "bounded";
    const Mesh a = read_mesh(argv[2]), b = read_mesh(argv[3]);
    const double tolerance = std::atof(argv[4]);
    const unsigned samples = std::atoi(argv[5]);
    std::printf("{\"version\": \"%s\"}\n", CGAL_STR(CGAL_VERSION));
    std::fflush(stdout);

    for (std::string line; std::getline(std::cin, line);) {
        std::ofstream("/proc/self/clear_refs") << "5";  // forgets the peak of reading
        const double before = status_mib("VmRSS:");
        const auto wall = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        const double value = bounded
            ? PMP::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(a, b, tolerance)
            : PMP::approximate_Hausdorff_distance<CGAL::Sequential_tag>(
                  a, b, CGAL::parameters::number_of_points_on_faces(samples));
        const double cpu_ms = 1e3 * (std::clock() - cpu) / CLOCKS_PER_SEC;
        const double wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall).count();
        const double peak = status_mib("VmHWM:");
        if (std::isfinite(value)) std::printf("{\"value\": %.17g", value);
        else std::printf("{\"value\": %s", std::isnan(value) ? "NaN" : "Infinity");  // as Python's json spells them
        std::printf(", \"wall_ms\": %.6f, \"cpu_ms\": %.6f, \"peak_mib\": %.3f, \"memory_over_start_mib\": %.3f}\n",
                    wall_ms, cpu_ms, peak, peak > before ? peak - before : 0.0);
        std::fflush(stdout);
    }
} catch (const std::exception &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
