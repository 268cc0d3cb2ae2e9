"""The same ranking, the same matrix and the same sweep on a Ray cluster; needs ``pip install pompeiu[ray]``.

Tasks are pure functions of meshes, and the driver takes the results of a round in the order of its tasks: so the same bits come out
as on one machine, whichever worker did what, and however often.

>>> import pompeiu, pompeiu.ray, ray            # doctest: +SKIP
>>> ray.init("auto")                            # doctest: +SKIP
>>> pompeiu.ray.rank("template.ply", paths)     # doctest: +SKIP

Without ``ray.init`` a cluster of this machine alone is started. The package must be installed where the workers run.
"""

from __future__ import annotations

import json
import os
from functools import lru_cache
from typing import Any, Callable, Iterable, Iterator, List, Sequence, Union

import ray

from . import _native
from ._asking import split
from ._native import Mesh
from .errors import OptionError, ReadError
from .many import DistanceMatrix, RankReport, Targets, named, usable
from .neurons import NeuronTransport, _sweep_inputs, _sweep_task
from .progress import StepsLike, watching_steps
from .sources import MeshLike, as_mesh

__all__ = ["matrix", "rank", "sweep_neurons"]

#: How often a task is tried again when the worker that did it is lost.
RETRIES = 5

#: Tasks under way for each that can run at a time: the next is there when one ends, and few wait on a worker that is slow.
TASKS_PER_PLACE = 2

#: Meshes that are measured to another in one task, which builds the tree of the other once.
MESHES_PER_TASK = 8


@lru_cache(maxsize=2)
def _template(mesh: "ray.ObjectRef", options: str) -> Any:
    """The template, prepared once in each worker process."""
    return _native.Template(ray.get(mesh), options)


@ray.remote(max_retries=RETRIES)
def _perform(template: "list[ray.ObjectRef]", options: str, mesh: Mesh, action: str, threads: int) -> str:
    """A task of a ranking. The template comes in a list so that Ray does not unpack it for every task."""
    return _template(template[0], options).perform(mesh, action, threads)


@ray.remote(max_retries=RETRIES)
def _measure(to: Mesh, sources: "list[ray.ObjectRef]", options: str, threads: int) -> List[str]:
    """A task of a matrix: how far some meshes are from another."""
    return _native.matrix_entries(to, ray.get(sources), options, threads)


@ray.remote(max_retries=RETRIES)
def _move(content: bytes, config: str, viscous: bool, frames: int, options: Any) -> NeuronTransport:
    """A task of a sweep: transport through one neuron with one configuration."""
    return _sweep_task(content, config, viscous, frames, options)


class _Stopped(Exception):
    """The callback wants no more."""


def _in_order(submissions: Iterable[Callable[[], Any]], places: int, done: Callable[[], None]) -> List[Any]:
    """Results in the order of submissions, while at most so many tasks are under way.

    Tasks are handed out as others end, so that a worker that is quick, or new, gets more of them.
    """
    results: List[Any] = []
    waiting: "dict[ray.ObjectRef, int]" = {}
    left: Iterator[Callable[[], Any]] = iter(submissions)
    more = True
    try:
        while True:
            while more and len(waiting) < places:
                submit = next(left, None)
                if submit is None:
                    more = False
                    break
                results.append(None)
                submitted = submit()
                if isinstance(submitted, ray.ObjectRef):
                    waiting[submitted] = len(results) - 1
                else:
                    results[-1] = submitted
                    done()
            if not waiting:
                return results
            ready, _ = ray.wait(list(waiting), num_returns=1)
            for reference in ready:
                results[waiting.pop(reference)] = ray.get(reference)
                done()
    finally:
        for reference in waiting:
            ray.cancel(reference, force=True)


def _places(threads: int) -> int:
    """How many tasks to have under way on this cluster."""
    if not ray.is_initialized():
        ray.init()
    if threads < 1:
        raise OptionError(f"the number of threads of a task is {threads}; at least 1 is needed")
    return max(1, TASKS_PER_PLACE * int(ray.cluster_resources().get("CPU", 1)) // threads)


def rank(template: MeshLike, targets: Targets, *, threads: int = 1, progress: StepsLike = None, **options: Any) -> RankReport:
    """Ranks targets as :func:`pompeiu.rank` does, on a Ray cluster; the report is the same to the last bit.

    Meshes are read where this is called, put into Ray's object store once, and shared by the workers of a node; one that cannot
    come back, because it was discarded, is let go. Tasks of a worker that is lost are done by others.

    Parameters
    ----------
    template, targets, progress
        As for :func:`pompeiu.rank`.
    threads : int
        Processors that one task takes.
    **options
        ``top``, ``all``, ``direction``, ``align``, ``tolerance``, ``tolerance_kind``, as for :func:`pompeiu.rank`.

    Returns
    -------
    RankReport

    Raises
    ------
    MeshError, ReadError, OptionError
        As for :func:`pompeiu.rank`.
    ray.exceptions.RayError
        If a task fails on more workers than it is tried on.
    """
    request, _, _ = split(options)
    pairs = named(targets)
    sources = [s if isinstance(s, (str, os.PathLike)) else as_mesh(s) for _, s in pairs]
    ranking = _native.Ranking([name for name, _ in pairs], request)
    template = as_mesh(template)
    _native.Template(template, request)  # What is wrong with it is an error here, not on a worker.
    places = _places(threads)
    shared = [ray.put(template)]
    store: "dict[int, ray.ObjectRef]" = {}

    def submission(target: int, action: str) -> Callable[[], Any]:
        def submit() -> Any:
            if target not in store:
                try:
                    store[target] = ray.put(as_mesh(sources[target]))
                except ReadError as error:
                    return json.dumps({"failed": str(error)})
            return _perform.options(num_cpus=threads).remote(shared, request, store[target], action, threads)

        return submit

    with watching_steps(progress, "targets settled") as watch:
        while tasks := ranking.round():
            ended, settled = [0], ranking.settled()

            def done() -> None:
                ended[0] += 1
                if watch is not None and watch(ended[0], len(tasks), settled, len(sources)) is False:
                    raise _Stopped

            try:
                outcomes = _in_order((submission(*task) for task in tasks), places, done)
            except _Stopped:
                ranking.stop()
                return RankReport._of(json.loads(ranking.report()))
            ranking.merge(outcomes)
            for target in [target for target in store if not ranking.wants(target)]:
                del store[target]
    return RankReport._of(json.loads(ranking.report()))


def matrix(
    meshes: Targets, *, threads: int = 1, progress: StepsLike = None, **options: Any
) -> DistanceMatrix:
    """Encloses the distances of all pairs as :func:`pompeiu.matrix` does, on a Ray cluster; the same to the last bit.

    Parameters
    ----------
    meshes, progress
        As for :func:`pompeiu.matrix`.
    threads : int
        Processors that one task takes.
    **options
        ``directed``, ``tolerance``, ``tolerance_kind``, as for :func:`pompeiu.matrix`.

    Returns
    -------
    DistanceMatrix

    Raises
    ------
    MeshError, ReadError, OptionError, ray.exceptions.RayError
        As for :func:`rank`.
    """
    usable_meshes = usable(meshes)
    request, _, _ = split(options)
    count = len(usable_meshes.meshes)
    entries = _native.Entries(count, request)  # What is wrong with an option is an error here, not on a worker.
    places = _places(threads)
    store = [ray.put(mesh) for mesh in usable_meshes.meshes]
    blocks = []
    for to in range(count):
        others = [place for place in range(count) if place != to]
        blocks += [(to, others[at : at + MESHES_PER_TASK]) for at in range(0, len(others), MESHES_PER_TASK)]

    def submission(to: int, sources: List[int]) -> Callable[[], Any]:
        task = _measure.options(num_cpus=threads)
        return lambda: task.remote(store[to], [store[place] for place in sources], request, threads)

    with watching_steps(progress, "blocks") as watch:
        ended = [0]

        def done() -> None:
            ended[0] += 1
            if watch is not None and watch(ended[0], len(blocks), ended[0], len(blocks)) is False:
                raise _Stopped

        try:
            results = _in_order((submission(*block) for block in blocks), places, done)
        except _Stopped:
            entries.stop()
            results = []
    for (to, sources), found in zip(blocks, results):
        entries.set(to, list(zip(sources, found)))
    report, lower, upper = entries.report()
    return DistanceMatrix._of(json.loads(report), (lower, upper), bool(options.get("directed", False)), usable_meshes)


def sweep_neurons(
    skeletons: Sequence[Union[str, "os.PathLike[str]", bytes]],
    configs: Sequence[Union[str, "os.PathLike[str]"]],
    *,
    viscous: bool = False,
    repair: bool = False,
    parts: int = 2,
    layer: float = 2.0,
    frames: int = 2,
    threads: int = 1,
) -> List[List[NeuronTransport]]:
    """Transport through several neurons as :func:`pompeiu.sweep_neurons` has it, on a Ray cluster; the same to the last bit.

    Each pair of a skeleton and a configuration is a task; a worker that has meshed a skeleton keeps the mesh for the next.

    Parameters
    ----------
    skeletons, configs, viscous, repair, parts, layer, frames
        As for :func:`pompeiu.sweep_neurons`.
    threads : int
        Processors that one task takes.

    Returns
    -------
    list of list of NeuronTransport
        For each skeleton, one for each configuration.

    Raises
    ------
    ReadError, OptionError, ray.exceptions.RayError
        As for :func:`rank`; what is wrong with a configuration is said by the task that comes to it.
    """
    contents, texts = _sweep_inputs(skeletons, configs, frames)
    places = _places(threads)
    store = [ray.put(content) for content in contents]
    options = (bool(repair), int(parts), float(layer), int(threads))
    task = _move.options(num_cpus=threads)

    def submission(content: "ray.ObjectRef", text: str) -> Callable[[], Any]:
        return lambda: task.remote(content, text, viscous, frames, options)

    pairs = [submission(content, text) for content in store for text in texts]
    results = _in_order(pairs, places, lambda: None)
    count = len(texts)
    return [results[count * k : count * (k + 1)] for k in range(len(store))]
