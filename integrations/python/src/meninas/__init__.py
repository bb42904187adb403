"""Meninas renders rooms with mirrors: radiosity with mirror worlds, then ray tracing.

    room = meninas.load("room.gltf", quality="draft")
    picture = room.render(size="640x480")        # (480, 640, 3) float32, linear radiance, W/m^2/sr
    picture.write("room.png")
    solution = room.solve()                      # irradiance of all surfaces, for any number of pictures

Settings are the options of `meninas render` by their names, with underscores for dashes: text, numbers, True for a
flag, a list for what may be given several times. Lengths are metres, +Y is up; radiosity and irradiance are W/m^2;
colours are linear red, green and blue. Arrays show the memory of the library and cannot be written.

`warning` is called with a line of text, `progress` with a stage and the share of it that is done; where it returns
False, or on Ctrl-C, the call ends. What goes wrong is an Error of one line, as the program says it.
"""

import json
import os
import sys

import numpy

__all__ = ["load", "read_picture", "diff", "Room", "Solution", "FormFactors", "Picture", "Error", "UsageError",
           "InputError", "OutputError", "Cancelled", "__version__"]


class Error(Exception):
    """One line: FILE: WHERE: WHAT."""


class UsageError(Error, ValueError):
    """A setting, name or shape that is not known, or does not go with others."""


class InputError(Error):
    """A file that cannot be read, or says nothing meaningful."""


class OutputError(Error):
    """A file that cannot be written, or memory that is not there."""


class Cancelled(Error):
    """`progress` has returned False."""


from . import _meninas  # noqa: E402  (it raises the errors above)

__version__ = _meninas.version()


def _warn(text):
    print("meninas: warning:", text, file=sys.stderr)


def _file(value):
    """A path as text."""
    try:
        text = os.fsdecode(value)
    except (TypeError, UnicodeError):
        raise UsageError(f"file: {value!r} is no path") from None
    if "\0" in text:
        raise UsageError(f"file: {text!r} is no path")
    return text


def _text(value):
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return ",".join(_text(part) for part in value)
    if isinstance(value, (float, numpy.floating)):
        return repr(float(value))
    if isinstance(value, os.PathLike):
        return _file(value)
    return str(value)


# Lists of these are one value; of all others several of the same name.
_JOINED = {"layers", "background", "sun", "place"}


def _size(value):
    try:
        width, height = value
        if int(width) == width and int(height) == height:
            return f"{int(width)}x{int(height)}"
    except (TypeError, ValueError):
        pass
    raise UsageError(f"size: {value!r} is not (width, height)")


def _settings(named):
    """Pairs of names and texts; None, False and empty lists are left out."""
    pairs = []
    for name, value in named.items():
        option = name.replace("_", "-")
        if value is None or (isinstance(value, (bool, numpy.bool_)) and not value):
            continue
        if isinstance(value, (bool, numpy.bool_)):
            pairs.append((option, ""))
        elif option == "size" and not isinstance(value, str):
            pairs.append((option, _size(value)))
        elif option == "lamp" and isinstance(value, dict):
            pairs.extend((option, f"{lamp}={_text(factor)}") for lamp, factor in value.items())
        elif isinstance(value, (list, tuple)) and len(value) == 0:
            continue
        elif isinstance(value, (list, tuple)) and option not in _JOINED:
            pairs.extend((option, _text(one)) for one in value)
        else:
            pairs.append((option, _text(value)))
    return pairs


def _colours(named, what):
    """Names with three numbers each: one stands for a grey."""
    if not isinstance(named, dict):
        raise UsageError(f"{what}: {named!r} is no dict of names and numbers")
    pairs = []
    for lamp, factor in named.items():
        try:
            three = numpy.asarray(factor, dtype=float)
        except (TypeError, ValueError):
            three = numpy.zeros(2)
        if not isinstance(lamp, str) or three.shape not in ((), (1,), (3,)):
            raise UsageError(f"{what}: {lamp!r} takes a number, or red, green and blue")
        pairs.append((lamp, [float(channel) for channel in numpy.broadcast_to(three, (3,))]))
    return pairs


def _array(values, name):
    try:
        return numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: numbers are wanted") from None


class Picture(numpy.ndarray):
    """Linear radiance, shape (height, width, 3), float32, W/m^2/sr, rows from the top.

    `layers` is a dict of arrays of the same shape, `stats` the figures of the run (docs/stats.md). What is computed from
    a picture is an ordinary array, and a part of one has no layers, figures or file.
    """

    def __new__(cls, inner):
        picture = inner.pixels().view(cls)
        picture._inner = inner
        return picture

    def __array_finalize__(self, other):
        self._inner = None

    def __array_wrap__(self, result, context=None, return_scalar=False):
        return numpy.asarray(result)[()]

    def copy(self, order="C"):
        return numpy.array(self, order=order, subok=False)

    def _whole(self):
        if self._inner is None:
            raise UsageError("picture: what is computed from a picture, or a part of one, has no layers or file")
        return self._inner

    @property
    def layers(self):
        inner = self._whole()
        return {name: inner.layer(name) for name in inner.layers()}

    @property
    def stats(self):
        text = self._whole().stats()
        return json.loads(text) if text else {}

    def write(self, file, **settings):
        """Writes .exr or .hdr, which are linear, or .png. Settings: exposure, view_transform, depth, float."""
        self._whole().write(_file(file), _settings(settings))


class Solution:
    """Pass one: the irradiance of all diffuse surfaces, at the vertices of elements.

    vertices (n, 3) m; irradiance (n, 3) W/m^2; elements (m, 4) vertices, a triangle repeats its third; area (m,) m^2;
    nodes (m,) places in Room.nodes; stats, the figures of the solve.
    """

    def __init__(self, inner):
        self._inner = inner

    vertices = property(lambda self: self._inner.vertices())
    irradiance = property(lambda self: self._inner.irradiance())
    elements = property(lambda self: self._inner.elements())
    area = property(lambda self: self._inner.area())
    nodes = property(lambda self: self._inner.node_of_element())
    stats = property(lambda self: json.loads(self._inner.stats()))

    def write(self, file):
        """Writes a .glb that any viewer shows, and that `Room.read_solution` and `meninas render --solution` take."""
        self._inner.write(_file(file))

    def render(self, camera=None, warning=_warn, progress=None, **settings):
        """Pass two: the picture of a camera, the first one of the file unless it is named."""
        return Picture(self._inner.render(_settings({"camera": camera, **settings}), warning, progress))

    def relight(self, lamps):
        """The same room with lamps so many times as bright: a dict of numbers, or of red, green and blue; `all` is
        every lamp. Exact, without solving again. The solution has to know its lamps: `solve(by_lamp=True)`."""
        return Solution(self._inner.relit(_colours(lamps, "lamps")))

    def irradiance_at(self, points, normals, progress=None):
        """What arrives at points, (n, 3) in metres, on the side of their normals: a dict of `total`, `direct` and
        `by_mirrors`, (n, 3) W/m^2, and `inside`, (n,), true where a point is inside of something."""
        points = numpy.atleast_2d(_array(points, "points"))
        normals = numpy.atleast_2d(_array(normals, "normals"))
        if normals.shape[0] == 1 and points.ndim == 2 and points.shape[0] > 1:
            normals = numpy.repeat(normals, points.shape[0], axis=0)
        return self._inner.irradiance_at(points, normals, progress)


class FormFactors:
    """T of Eq. 1 between the elements of a uniform mesh: H_i = sum_j T_ij B_j, light by way of mirrors included.

    area (n,) m^2; centre, normal (n, 3); reflectance, emission (n, 3), emission in W/m^2; nodes (n,) places in
    Room.nodes. Without mirrors T_ij is the form factor F_ij.
    """

    def __init__(self, inner, names):
        self._inner = inner
        self._names = names

    area = property(lambda self: self._inner.area())
    centre = property(lambda self: self._inner.centre())
    normal = property(lambda self: self._inner.normal())
    reflectance = property(lambda self: self._inner.reflectance())
    emission = property(lambda self: self._inner.emission())
    nodes = property(lambda self: self._inner.node_of_element())

    def __len__(self):
        return self._inner.size()

    def arrays(self, channel=0):
        """(data, indices, indptr) of compressed sparse rows, by column: scipy.sparse.csr_matrix(f.arrays(), shape=f.shape).
        They are copies, for SciPy writes into what it is given."""
        channels = self._inner.channels()
        if channel not in (0, 1, 2):
            raise UsageError(f"channel: {channel!r} is not 0, 1 or 2")
        weights = self._inner.weights()
        data = weights if channels == 1 else weights[:, channel]
        begin = self._inner.row_begin()
        index = numpy.int32 if begin[-1] < 2**31 else numpy.int64
        return numpy.array(data), self._inner.columns().astype(index), begin.astype(index)

    @property
    def shape(self):
        return len(self), len(self)

    def elements_of(self, node):
        """The elements of a node, by its name or place."""
        places = [place for place, name in enumerate(self._names) if name == node]
        if not isinstance(node, (str, bytes)) and isinstance(node, (int, numpy.integer)) and 0 <= node < len(self._names):
            places = [node]
        if not places:
            raise UsageError(f"node: there is no {node!r}")
        return numpy.flatnonzero(numpy.isin(self.nodes, places))

    def between(self, node, other, channel=0):
        """The dense matrix of T from the elements of a node to those of another."""
        rows, columns = self.elements_of(node), self.elements_of(other)
        data, indices, indptr = self.arrays(channel)
        place = numpy.full(len(self), -1, dtype=numpy.int64)
        place[columns] = numpy.arange(columns.size)
        block = numpy.zeros((rows.size, columns.size), dtype=numpy.float32)
        for k, row in enumerate(rows):
            begin, end = int(indptr[row]), int(indptr[row + 1])
            at = place[indices[begin:end]]
            block[k, at[at >= 0]] = data[begin:end][at >= 0]
        return block

    def solve(self, emission=None, progress=None, **settings):
        """B = E + rho T B: a dict of `radiosity` (n, 3) W/m^2, `iterations`, `residual`, `error_bound`, `converged`.
        Emission (n, 3) W/m^2, of the scene where it is left out. Settings: solver, tolerance."""
        given = None if emission is None else _array(emission, "emission")
        return self._inner.solve(given, _settings(settings), progress)


class Room:
    """A scene as its file says it. See `load`."""

    def __init__(self, inner):
        self._inner = inner

    nodes = property(lambda self: self._inner.nodes())
    cameras = property(lambda self: self._inner.cameras())
    lamps = property(lambda self: self._inner.lamps())

    def plan(self, **settings):
        """What the room contains, what will be modelled and what is odd about it (`meninas plan --json`)."""
        return json.loads(self._inner.plan(_settings(settings)))

    def render(self, camera=None, warning=_warn, progress=None, **settings):
        """Both passes for one camera, the first one of the file unless it is named: a Picture."""
        return Picture(self._inner.render(_settings({"camera": camera, **settings}), warning, progress))

    def emitting(self, emission):
        """The same room where all faces of some nodes emit so much in place of what the file says: a dict of their names
        and E in W/m^2, a number or red, green and blue. Its solutions belong to it, not to the file."""
        return Room(self._inner.emitting(_colours(emission, "emission")))

    def solve(self, lamps=None, by_lamp=None, warning=_warn, progress=None, emission=None, **settings):
        """Pass one: a Solution. `emission` is a dict of nodes and what their faces emit, W/m^2 (see `emitting`);
        `by_lamp` (True, "node" or "material") tells lamps apart; `lamps` is a dict of what each is multiplied by."""
        if emission is not None:
            return self.emitting(emission).solve(lamps, by_lamp, warning, progress, **settings)
        by_lamp = by_lamp or (True if lamps else None)
        solution = Solution(self._inner.solve(_settings({"by_lamp": by_lamp, **settings}), warning, progress))
        return solution.relight(lamps) if lamps else solution

    def read_solution(self, file, warning=_warn):
        """A Solution that `write` or `meninas solve` has made of this scene."""
        return Solution(self._inner.read_solution(_file(file), warning))

    def form_factors(self, method="rays", worlds=True, warning=_warn, progress=None, **settings):
        """FormFactors by rays, hemicube or analytic; without light by way of mirrors where `worlds` is False.
        Settings: elements, element_size, rays, hemicube_resolution, seed."""
        if not worlds:
            settings = {**settings, "mirror_depth": 0}
        inner = self._inner.form_factors(_settings({"form_factors": method, **settings}), warning, progress)
        return FormFactors(inner, self.nodes)


def load(file, warning=_warn, **settings):
    """A Room from a .gltf or .glb file. Settings hold for all its calls; which state of the file is shown, its units
    and what surrounds it (variant, at, environment, sky, background, ...) can be said here alone."""
    return Room(_meninas.Room(_file(file), _settings(settings), warning))


def read_picture(file):
    """A Picture from an EXR, HDR, PNG, JPEG, WebP or TIFF file."""
    return Picture(_meninas.Picture.read(_file(file)))


def diff(picture, reference):
    """How far a picture is from its reference: a dict of rmse, relmse, mae, psnr, max_abs, ssim and flip."""
    for given in (picture, reference):
        if not isinstance(given, Picture):
            raise UsageError("diff: pictures are wanted, as render and read_picture give them")
    return _meninas.distance(picture._whole(), reference._whole())
