// With assertions on, CGAL answers a broken mesh by ending the program. Every rule that a mesh can break is
// checked below, so that it becomes a message instead, in debug builds too.
#ifndef NDEBUG
#define NDEBUG
#endif

#include "bridge/bridge.h"

#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <locale>
#include <new>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/OBJ.h>
#include <CGAL/boost/graph/IO/OFF.h>
#include <CGAL/boost/graph/IO/PLY.h>
#include <CGAL/boost/graph/IO/STL.h>
#include <CGAL/version.h>

namespace
{

namespace pmp = CGAL::Polygon_mesh_processing;
using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using point = kernel::Point_3;
using surface = CGAL::Surface_mesh<point>;
using vertex = surface::Vertex_index;
using face = surface::Face_index;

enum { DIGITS = 17 }; // decimals that give back every double

void say(char message[VES_BRIDGE_TEXT], const char *format, ...)
{
    if (!message) return;
    va_list list;
    va_start(list, format);
    std::vsnprintf(message, VES_BRIDGE_TEXT, format, list);
    va_end(list);
}

ves_status fault(char message[VES_BRIDGE_TEXT], const char *format, ...)
{
    if (!message) return VES_FAULT;
    va_list list;
    va_start(list, format);
    std::vsnprintf(message, VES_BRIDGE_TEXT, format, list);
    va_end(list);
    return VES_FAULT;
}

// Predicates on a point that is not finite never end, and CGAL follows an index without looking at it.
ves_status check(const ves_mesh &mesh, char message[VES_BRIDGE_TEXT])
{
    std::vector<char> used(mesh.vertices > 0 ? mesh.vertices : 0);
    if (mesh.vertices < 3 || mesh.triangles < 1) return fault(message, "the mesh has no triangle");
    for (int t = 0; t < mesh.triangles; t++) {
        const int *c = mesh.corner + 3 * (size_t)t;
        for (int k = 0; k < 3; k++) {
            if (c[k] < 0 || c[k] >= mesh.vertices)
                return fault(message, "triangle %d has the corner %d, outside 0 .. %d", t, c[k],
                             mesh.vertices - 1);
            used[c[k]] = 1;
        }
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
            return fault(message, "triangle %d (%d, %d, %d) has a corner twice", t, c[0], c[1], c[2]);
    }
    for (int v = 0; v < mesh.vertices; v++) {
        const double *x = mesh.point + 3 * (size_t)v;
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
            return fault(message, "vertex %d is not finite", v);
        if (!used[v]) return fault(message, "vertex %d belongs to no triangle", v);
    }
    return VES_OK;
}

ves_status build(const ves_mesh &mesh, surface &out, char message[VES_BRIDGE_TEXT])
{
    say(message, "");
    VES_TRY(check(mesh, message));
    out.reserve(mesh.vertices, 3 * (size_t)mesh.triangles / 2 + 1, mesh.triangles);
    for (int v = 0; v < mesh.vertices; v++) {
        const double *x = mesh.point + 3 * (size_t)v;
        out.add_vertex(point(x[0], x[1], x[2]));
    }
    for (int t = 0; t < mesh.triangles; t++) {
        const int *c = mesh.corner + 3 * (size_t)t;
        if (out.add_face(vertex(c[0]), vertex(c[1]), vertex(c[2])) == surface::null_face())
            return fault(
                message,
                "triangle %d (%d, %d, %d) does not fit: an edge already has two sides, a neighbour runs "
                "the other way round, or sheets meet in a single point",
                t, c[0], c[1], c[2]);
    }
    return VES_OK;
}

// All but the triangles without an area, which CGAL would count as crossing themselves; they are told. (Their
// neighbours still count when they touch each other across them.)
std::vector<face> solid(const surface &mesh, char message[VES_BRIDGE_TEXT])
{
    std::vector<face> faces;
    int flat = 0, first = -1;
    faces.reserve(mesh.number_of_faces());
    for (face f : mesh.faces()) {
        surface::Halfedge_index h = mesh.halfedge(f);
        const point &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
        if (!CGAL::collinear(p, q, mesh.point(mesh.target(mesh.next(h)))))
            faces.push_back(f);
        else if (flat++ == 0)
            first = (int)(std::size_t)f;
    }
    if (flat)
        say(message, "%d triangle%s no area, the first is %d", flat, flat > 1 ? "s have" : " has", first);
    return faces;
}

int crossing_pairs(const surface &mesh, const std::vector<face> &faces)
{
    std::vector<std::pair<face, face>> pairs;
    pmp::self_intersections<CGAL::Sequential_tag>(faces, mesh, std::back_inserter(pairs));
    return (int)pairs.size();
}

void judge(const surface &mesh, ves_mesh_facts *facts)
{
    *facts = ves_mesh_facts();
    for (surface::Edge_index e : mesh.edges()) facts->border_edges += mesh.is_border(e);
    facts->closed = facts->border_edges == 0;
    surface parts = mesh; // the map of components is a property, and the mesh given is constant
    auto label = parts.add_property_map<face, std::size_t>("f:part", 0).first;
    facts->components = (int)pmp::connected_components(parts, label);
    facts->area = pmp::area(mesh);
    facts->crossings = -1;
    if (!facts->closed) return;
    facts->outward = pmp::is_outward_oriented(mesh);
    facts->volume = pmp::volume(mesh);
}

struct triple {
    int corner[3];
    triple(int a, int b, int c) : corner{a, b, c} {}
};

// Twice the area of three corners of a polygon.
double turn(const double *xy, const int corner[3])
{
    const double *a = xy + 2 * corner[0], *b = xy + 2 * corner[1], *c = xy + 2 * corner[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

ves_status polygon(int count, const double *xy, int *corner, char message[VES_BRIDGE_TEXT])
{
    std::vector<point> rim;
    std::vector<triple> found;
    for (int k = 0; k < count; k++) rim.push_back(point(xy[2 * k], xy[2 * k + 1], 0));
    for (int k = 0; k < 2 * count; k++)
        if (!std::isfinite(xy[k])) return fault(message, "corner %d is not finite", k / 2);
    // Nothing but the plane's own triangulation: what else CGAL would try is for holes in space.
    pmp::triangulate_hole_polyline(rim, std::back_inserter(found),
                                   CGAL::parameters::use_2d_constrained_delaunay_triangulation(true)
                                       .use_delaunay_triangulation(false)
                                       .do_not_use_cubic_algorithm(true)
                                       .threshold_distance(1.));
    if (found.size() + 2 != rim.size()) return fault(message, "the polygon crosses itself");
    for (const triple &t : found) {
        for (int k = 0; k < 3; k++) corner[k] = t.corner[k];
        if (turn(xy, corner) < 0) std::swap(corner[1], corner[2]);
        corner += 3;
    }
    return VES_OK;
}

// Runs `work` and turns whatever C++ throws into a status.
template <class Work> ves_status guarded(char message[VES_BRIDGE_TEXT], Work work)
{
    try {
        return work();
    } catch (const std::bad_alloc &) {
        say(message, "%s", ves_status_text(VES_MEMORY));
        return VES_MEMORY;
    } catch (const std::exception &problem) {
        return fault(message, "CGAL: %s", problem.what());
    } catch (...) {
        return fault(message, "CGAL: unknown exception");
    }
}

enum class kind { stl, ply, obj, off, none };

kind kind_of(const char *path)
{
    const char *dot = std::strrchr(path, '.');
    if (!dot) return kind::none;
    if (!std::strcmp(dot, ".stl")) return kind::stl;
    if (!std::strcmp(dot, ".ply")) return kind::ply;
    if (!std::strcmp(dot, ".obj")) return kind::obj;
    return std::strcmp(dot, ".off") ? kind::none : kind::off;
}

bool put(std::ofstream &out, const surface &mesh, kind as)
{
    auto exact = CGAL::parameters::stream_precision(DIGITS);
    out.imbue(std::locale::classic());
    CGAL::IO::set_mode(out, as == kind::stl || as == kind::ply ? CGAL::IO::BINARY : CGAL::IO::ASCII);
    switch (as) {
    case kind::stl:
        return CGAL::IO::write_STL(out, mesh);
    case kind::ply:
        return CGAL::IO::write_PLY(out, mesh);
    case kind::obj:
        return CGAL::IO::write_OBJ(out, mesh, exact);
    default:
        return CGAL::IO::write_OFF(out, mesh, exact);
    }
}

ves_status write(const surface &mesh, const char *path, kind as, char message[VES_BRIDGE_TEXT])
{
    errno = 0;
    std::ofstream out(path, std::ios::binary);
    bool good = out.is_open() && put(out, mesh, as);
    out.close();
    if (good && out.good()) return VES_OK;
    say(message, "%s", std::strerror(errno ? errno : EIO));
    return VES_IO;
}

} // namespace

extern "C" ves_status ves_bridge_facts(const ves_mesh *mesh, bool pairs, ves_mesh_facts *facts,
                                       char message[VES_BRIDGE_TEXT])
{
    return guarded(message, [&] {
        surface built;
        ves_mesh_facts found;
        VES_TRY(build(*mesh, built, message));
        judge(built, &found);
        std::vector<face> faces = solid(built, message);
        if (pairs) found.crossings = crossing_pairs(built, faces);
        *facts = found;
        return VES_OK;
    });
}

extern "C" ves_status ves_bridge_crosses(const ves_mesh *mesh, bool *crosses, char message[VES_BRIDGE_TEXT])
{
    return guarded(message, [&] {
        surface built;
        VES_TRY(build(*mesh, built, message));
        *crosses = pmp::does_self_intersect<CGAL::Sequential_tag>(solid(built, message), built);
        return VES_OK;
    });
}

extern "C" ves_status ves_bridge_write(const ves_mesh *mesh, const char *path, char message[VES_BRIDGE_TEXT])
{
    return guarded(message, [&] {
        surface built;
        kind as = kind_of(path);
        if (as == kind::none) {
            say(message, "the name must end in .stl, .ply, .obj or .off");
            return VES_IO;
        }
        VES_TRY(build(*mesh, built, message));
        return write(built, path, as, message);
    });
}

extern "C" ves_status ves_bridge_polygon(int count, const double *xy, int *corner,
                                         char message[VES_BRIDGE_TEXT])
{
    return guarded(message, [&] {
        say(message, "");
        return polygon(count, xy, corner, message);
    });
}

extern "C" const char *ves_bridge_version(void)
{
    return CGAL_VERSION_STR;
}
