p='/work/doors/python/pompeiu/distance.py'
s=open(p).read()
a=s.index("def _options("); b=s.index("def hausdorff(")
s=s[:a]+'''@dataclass(frozen=True)
class Distance:
    """The distance of two meshes, in one direction or both.

    Attributes
    ----------
    a_to_b, b_to_a : DirectedReport or None
        How far A is from B, and B from A; ``None`` where only the other direction was asked for.
    hausdorff : SymmetricReport or None
        The Pompeiu–Hausdorff distance, where both directions were asked for.
    answer : str or None
        Whether the distance is at most ``assert_below``: ``"below"``, ``"above"`` or ``"undecided"``.
    stop : str
        Why the search ended; the intervals hold in every case.
    report : dict
        What ``pompeiu distance --json`` says in ``report``: with ``trace``, how the interval narrowed; with ``align``, how B was moved.
    """

    a_to_b: Optional[DirectedReport]
    b_to_a: Optional[DirectedReport]
    hausdorff: Optional[SymmetricReport]
    answer: Optional[str]
    stop: str
    report: "dict[str, Any]" = field(repr=False)


def distance(
    a: MeshLike,
    b: MeshLike,
    *,
    progress: ProgressLike = None,
) -> Distance:
    """Encloses the distance of two meshes, of all points of all faces: the question of ``pompeiu distance``.

    Parameters
    ----------
    a, b : MeshLike
        Two meshes in one unit of length; see :func:`pompeiu.as_mesh`.
    progress : bool or callable, optional
        ``True`` for a bar if tqdm is there, or a function that is called with a :class:`pompeiu.Progress`; if it returns
        ``False`` the search ends with what is proven.

    Raises
    ------
    MeshError, ReadError
        If an argument is no mesh.
    OptionError
        If an option means nothing.
    KeyboardInterrupt
        On Ctrl-C, within a fraction of a second.

    Examples
    --------
    >>> import pompeiu
    >>> ball, cube = pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.cube(2.0, 1)
    >>> pompeiu.distance(ball, cube, assert_below=0.5).answer
    'above'
    """
    return _asked(locals())


def _asked(given: "dict[str, Any]") -> Distance:
    with watching(given.pop("progress")) as watch:
        answer, _ = ask("distance", {**given, "progress": watch}, ("a", "b"))
    report = answer["report"]
    a_to_b, b_to_a = (_directed(report.get(way), ends) for way, ends in (("a_to_b", "ab"), ("b_to_a", "ba")))
    both = None
    if a_to_b is not None and b_to_a is not None:
        both = SymmetricReport(report["hausdorff"]["lower"], report["hausdorff"]["upper"], a_to_b, b_to_a)
    threshold = report.get("threshold")
    return Distance(a_to_b, b_to_a, both, threshold and threshold["answer"], answer["stop"], report)


def _directed(report: "Optional[dict[str, Any]]", ends: str) -> Optional[DirectedReport]:
    if report is None:
        return None
    witness = {name: report["witness"][mesh] for name, mesh in zip(("from", "to"), ends)}
    return DirectedReport._of({**report, "witness": witness})


'''+s[b:]
# hausdorff body
a=s.index("    options = _options(tolerance"); b=s.index("def directed_hausdorff(")
s=s[:a]+'''    for one in (a, b):
        if isinstance(one, Target):
            raise TypeError("a Target answers for one direction; use directed_hausdorff, or hand in the mesh")
    return _asked(_given(locals(), "both")).hausdorff


def _given(given: "dict[str, Any]", direction: str) -> "dict[str, Any]":
    """The arguments of a question about a distance."""
    names = ("a", "b", "tolerance", "tolerance_kind", *_LIMITS, "method", "progress")
    return {**{name: given[name] for name in names}, "assert_below": given["threshold"], "direction": direction}


'''+s[b:]
a=s.rindex("    options = _options(tolerance")
s=s[:a]+'''    given = locals()
    if not isinstance(b, Target):
        return _asked(_given(given, "a-to-b")).a_to_b
    options = {name: given[name] for name in ("tolerance", "tolerance_kind", "threshold", *_LIMITS, "method")}
    with watching(progress) as watch:
        return DirectedReport._of(json.loads(b._native.directed_from(as_mesh(a), options, watch)))
'''
s=s.replace('''import json
from typing import Any, Literal, Optional, Tuple, Union

from . import _native
from .progress''','''import json
from dataclasses import dataclass, field
from typing import Any, Literal, Optional, Tuple, Union

from . import _native
from ._asking import ask
from .progress''')
s=s.replace('__all__ = ["DEFAULT_TOLERANCE", "Target", "directed_hausdorff", "hausdorff"]','__all__ = ["DEFAULT_TOLERANCE", "Distance", "Target", "directed_hausdorff", "distance", "hausdorff"]')
s=s.replace('Method = Literal["fast", "classic"]\n','Method = Literal["fast", "classic"]\n\n_LIMITS = ("threads", "time_limit", "memory_limit")\n')
open(p,'w').write(s)
p='/work/doors/python/pompeiu/_native.pyi'
s=open(p).read()
import re
for name in ['hausdorff','directed_hausdorff']:
    m=re.search(r"\ndef %s\(.*?\.\.\.\n"%name,s,flags=re.S)
    print(m and m.group(0)); s=s.replace(m.group(0),"\n" if False else "")
open(p,'w').write(s)
