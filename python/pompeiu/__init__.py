"""How far apart are two surfaces, where, and can the number be trusted?

pompeiu computes the Pompeiu–Hausdorff distance between triangle meshes and answers with ``lower <= distance <= upper``, proven
to hold for the meshes as stored, rounding included, and with the two points that prove the lower end.

>>> import pompeiu
>>> report = pompeiu.hausdorff(pompeiu.shapes.cube(1.0), pompeiu.shapes.cube(2.0))
>>> 3 ** 0.5 / 2 in report
True

Meshes are paths, pairs of arrays, or objects of trimesh, meshio, Open3D or PyVista: see :func:`as_mesh`.
"""

from .alignment import Registration, align
from . import shapes
from ._native import Mesh, __version__
from .bands import BandReport, DirectedBands
from .certificates import Certificate, Certified, UnprovenStatement, Verified, verify
from .deviations import (
    Deviation,
    DeviationWork,
    DirectedDeviation,
    Enclosure,
    Histogram,
    Percentile,
    Region,
    ShareAbove,
    SignedStatistics,
    Statistics,
    Verdict,
    deviation,
    directed_deviation,
)
from .distance import DEFAULT_TOLERANCE, Distance, Target, directed_hausdorff, distance, hausdorff
from .errors import (
    FieldError,
    MeshError,
    MeshWarning,
    MissingFileError,
    OptionError,
    OutlineError,
    PompeiuError,
    ReadError,
    SurfaceError,
    UndecidedError,
    WriteError,
)
from .fields import (
    DegreesOfFreedom,
    FieldParts,
    FieldQuality,
    HodgeDecomposition,
    Ranks,
    SplitField,
    decompose,
    field_degrees_of_freedom,
)
from .contacts import Contact, contact
from .coupling import Coupled, couple
from .files import Info, info, mesh_summary, read_options, write_mesh
from .flattening import Cut, Flattening, Medial, Straightened, cut, flatten, medial, straighten
from .fluids import Fluid, Simulation, SquareSimulation, fluid
from .many import DistanceMatrix, RankReport, RankWork, Standing, matrix, rank
from .neurons import (
    Neuron,
    NeuronFlow,
    NeuronMesh,
    NeuronSplines,
    NeuronTransport,
    Skeleton,
    SkeletonCheck,
    neuron,
    read_neuron_mesh,
    read_skeleton,
    sweep_neurons,
)
from .outlines import Complexity, complexity, k_medoids, noisy_circle, polyline, read_outlines
from .puzzles import Puzzle, puzzle
from .repairing import Repaired, repair
from .results import (
    DirectedReport,
    MeshSummary,
    Progress,
    SurfacePoint,
    SymmetricReport,
    Timing,
    Witness,
    WorkCount,
)
from .sources import MeshLike, as_mesh, read_mesh
from .surfaces import Flow, Intersections, Remeshed, Simplified, flow, intersections, remesh, simplify

__all__ = [
    "BandReport",
    "Certificate",
    "Certified",
    "DEFAULT_TOLERANCE",
    "Complexity",
    "Contact",
    "Coupled",
    "Cut",
    "DegreesOfFreedom",
    "Deviation",
    "DeviationWork",
    "DirectedBands",
    "DirectedDeviation",
    "DirectedReport",
    "Distance",
    "DistanceMatrix",
    "Enclosure",
    "FieldError",
    "FieldParts",
    "FieldQuality",
    "Flattening",
    "Flow",
    "Fluid",
    "Histogram",
    "HodgeDecomposition",
    "Info",
    "Intersections",
    "Medial",
    "Mesh",
    "MeshError",
    "MeshLike",
    "MeshSummary",
    "MeshWarning",
    "MissingFileError",
    "Neuron",
    "NeuronFlow",
    "NeuronMesh",
    "NeuronSplines",
    "NeuronTransport",
    "OptionError",
    "OutlineError",
    "Percentile",
    "PompeiuError",
    "Progress",
    "Puzzle",
    "RankReport",
    "RankWork",
    "Ranks",
    "ReadError",
    "Region",
    "Registration",
    "Remeshed",
    "Repaired",
    "ShareAbove",
    "SignedStatistics",
    "Simplified",
    "Simulation",
    "SplitField",
    "SquareSimulation",
    "Skeleton",
    "SkeletonCheck",
    "Standing",
    "Statistics",
    "Straightened",
    "SurfaceError",
    "SurfacePoint",
    "SymmetricReport",
    "Target",
    "Timing",
    "UnprovenStatement",
    "Verdict",
    "Verified",
    "Witness",
    "WorkCount",
    "UndecidedError",
    "WriteError",
    "__version__",
    "align",
    "as_mesh",
    "complexity",
    "contact",
    "couple",
    "cut",
    "decompose",
    "deviation",
    "directed_deviation",
    "directed_hausdorff",
    "distance",
    "field_degrees_of_freedom",
    "flatten",
    "flow",
    "fluid",
    "hausdorff",
    "info",
    "intersections",
    "k_medoids",
    "matrix",
    "medial",
    "mesh_summary",
    "neuron",
    "noisy_circle",
    "polyline",
    "puzzle",
    "rank",
    "read_mesh",
    "read_neuron_mesh",
    "read_options",
    "read_outlines",
    "read_skeleton",
    "remesh",
    "repair",
    "shapes",
    "simplify",
    "straighten",
    "sweep_neurons",
    "verify",
    "write_mesh",
]
