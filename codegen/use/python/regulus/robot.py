# SPDX-License-Identifier: GPL-3.0-or-later
"""Robots, and the questions about them."""

from __future__ import annotations

import difflib
import json
import os
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

from . import _regulus
from .arguments import (
    assignments_of,
    count_of,
    elements_of,
    mapping_of,
    option_of,
    optional_path,
    path_of,
    places_of,
    proof_of,
    seconds_of,
    text_of,
    words_of,
)
from .errors import ArgumentTypeError, FileError, UsageError, require_package
from .numbers import Number, Numbers, Range, Texts
from .options import Options
from .paving import LoadPaving, Paving
from .results import Bound, Check, LoadCheck, Margin, Path, PreparedCheck, Verification
from .solutions import Solved, SolvedPlaces

if TYPE_CHECKING:
    from typing_extensions import Unpack

_LARGEST_MODEL = 4 << 20  # bytes


class Question:
    """A robot, a motion and the changes of a call: what is asked."""

    def __init__(
        self,
        robot: Robot,
        motion: str,
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        alpha: Optional[Number] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
    ) -> None:
        self._arguments = (robot, motion, range, tolerance, alpha, tube, waypoints)
        self.robot = robot
        self.waypoints = optional_path("waypoints", waypoints)
        self._options: dict[str, Any] = {}
        self.options = _regulus.SearchOptions()
        self.options.engine = "auto"
        self.texts = Texts()
        self.question: _regulus.Question = _regulus.Question(
            robot.text, robot.path or robot.name, text_of("motion", motion)
        )
        for name, ends in mapping_of("range", range).items():
            self.question.range(name, *self._ends(name, ends))
        for groups, value in mapping_of("tolerance", tolerance).items():
            self.question.tolerance(groups, self.texts.of(value, f"tolerance: {groups}"))
        if alpha is not None:
            self.question.alpha(self.texts.of(alpha, "alpha"))
        if waypoints is not None:
            self.question.waypoints(self.waypoints)
        self._set_tube(tube)

    def _ends(self, name: str, ends: Range) -> tuple[str, str]:
        pair = elements_of(ends)
        if pair is not None:
            if len(pair) != 2:
                raise UsageError(f"range: {name!r} has {len(pair)} numbers; give (lower, upper)")
            lower, upper = (self.texts.of(end, f"range: {name}") for end in pair)
            return lower, upper
        value = self.texts.of(ends, f"range: {name}")
        return value, value

    def _set_tube(self, tube: Union[None, Number, Mapping[str, Number]]) -> None:
        if tube is None:
            return
        if not isinstance(tube, Mapping):
            tube = {"": tube}
        for names, error in mapping_of("tube", tube).items():
            self.question.tube(names, self.texts.of(error, f"tube: {names}" if names else "tube"))

    def set_options(self, options: Mapping[str, Any]) -> None:
        """Sets options of the search, by their names on the command line with _ for -."""
        for name, value in options.items():
            if value is None:
                continue
            if name == "beyond_limits":
                if value:
                    self.question.beyond_limits()
                self._options[name] = value
                continue
            if not hasattr(self.options, name):
                known = ", ".join(n for n in dir(self.options) if not n.startswith("_"))
                raise ArgumentTypeError(f"unknown option {name!r}; the options are: {known}")
            setattr(self.options, name, option_of(name, value))
            self._options[name] = value

    def prove(self, path: str) -> str:
        """Searches, and writes the proof of the verdict to a file."""
        finding = _regulus.check(self.question, self.options, path)
        if not finding.certificate:
            raise UsageError(f"certificate: {finding.no_certificate}")
        return finding.certificate

    def __getstate__(self) -> tuple[Any, ...]:
        return (self._arguments, self._options)

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.__init__(*state[0])  # type: ignore[misc]
        self.set_options(state[1])


def _number_or_word(name: str, value: Union[str, int]) -> str:
    return value if isinstance(value, str) else str(count_of(name, value))


def _quantity(
    quantity: str,
    load: str,
    twist: str,
    leg: Union[str, int],
    freedom: str,
    least: bool,
    signed: bool,
    norm: Union[str, int] = "",
    finite: bool = False,
) -> _regulus.QuantityOptions:
    words = {"quantity": quantity, "load": load, "twist": twist, "freedom": freedom}
    for name, word in words.items():
        text_of(name, word)
    for name, flag in {"least": least, "signed": signed, "finite": finite}.items():
        if not isinstance(flag, bool):
            raise ArgumentTypeError(f"{name}: found {flag!r}; give True or False")
    return _regulus.QuantityOptions(
        quantity, load, twist, _number_or_word("leg", leg), freedom, least, signed,
        _number_or_word("norm", norm), finite,
    )


def _with_partial(stop: KeyboardInterrupt, make: Any) -> None:
    """Gives an interrupt the result that was found until then, or None, as `result`."""
    partial = getattr(stop, "partial", None)
    stop.result = make(partial) if partial is not None else None  # type: ignore[attr-defined]


class Robot:
    """A robot: the text of a model file.

    Robots are plain data: they can be copied, pickled, compared, and used by any thread. Searches
    of one process wait for each other; each search uses several threads itself.

    Attributes:
        text: the model file.
        path: where it was read; way-points are looked for beside it. "" if it was made in Python.
        name: the name of the robot.
        notes: remarks of the function that made the model.
    """

    def __init__(self, text: str, path: Path = "", notes: Sequence[str] = ()) -> None:
        """Reads a model.

        Raises:
            InputError: with file and line, if the text is not a model.
        """
        self.text = text_of("text", text)
        self.path = path_of("path", path)
        self.name = "robot"
        self.notes = list(notes)
        question = _regulus.Question(text, self.path or self.name)
        self._contents: dict[str, Any] = json.loads(_regulus.describe_model(question))
        self.name = self._contents["model"]

    @property
    def motions(self) -> dict[str, dict[str, tuple[str, str]]]:
        """The motions: by the name of each parameter its range, in its unit.

        The ends are texts for people: rational numbers are exact, others have six digits.
        """
        return {
            motion["name"]: {p["name"]: (p["lower"], p["upper"]) for p in motion["parameters"]}
            for motion in self._contents["motions"]
        }

    @property
    def groups(self) -> dict[str, list[str]]:
        """The groups of uncertain quantities, with the names of their members."""
        return {group["name"]: group["members"] for group in self._contents["groups"]}

    @property
    def loads(self) -> list[str]:
        """The names of the sets of wrenches."""
        return list(self._contents["loads"])

    @property
    def twists(self) -> list[str]:
        """The names of the sets of twists."""
        return list(self._contents["twists"])

    def check(
        self,
        motion: str = "",
        *,
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        alpha: Optional[Number] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> Check:
        """Proves that a motion has no singular pose, or shows one.

        Args:
            motion: its name; "" if the robot has only one.
            range: ranges of motion parameters, in their units, in the place of the motion's own.
            tolerance: tolerances of groups, in the units of the model: {"base,platform": "0.1"}.
            alpha: the threshold that |det J⁻¹| must exceed; None: that of the motion.
            tube: control errors, of all pose parameters or of those named: {"x,y": "0.01"}.
            waypoints: a file of way-points to follow instead of the motion's own poses.
            certificate: a file for the proof.
            shard_size: a larger proof is cut into files of about so many bytes; 0: it is one file.
            options: those of the command: threads, time_limit (seconds), max_boxes, method, engine,
                determinant, bisect, weights ({"psi": 2}), uncertainty, entries, isa, precision,
                use_cache, filters, without, symbolic_budget, beyond_limits (the joints may leave
                their limits), kernel (a C++ text of the kernel that you have edited).

        Raises:
            InputError: for the model; UsageError: for the arguments; FileError.
            KeyboardInterrupt: after Ctrl-C; its attribute `result` is the Check until then, or None.
        """
        question = Question(self, motion, range, tolerance, alpha, tube, waypoints)
        question.set_options(options)

        def result(finding: Any) -> Check:
            return Check(question, finding, question.texts.notes)

        proof = proof_of(certificate, shard_size)
        try:
            return result(_regulus.check(question.question, question.options, *proof))
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def locate(
        self,
        motion: str = "",
        *,
        resolution: Number = "",
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        alpha: Optional[Number] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> Paving:
        """Paves a motion with boxes that are proved free, proved singular, or undecided.

        Args:
            resolution: boxes are split until each side is at most this part of its range, in
                (0, 1]; by default between 1/512 for one range and 1/4 for six.

        A motion along way-points is divided into `stretches`, and has no boxes; by default
        `resolution` is then 1/512 of a segment. The others and the errors are as for check(); the
        `result` of an interrupt is a Paving.
        """
        require_package("numpy", "locate()")
        question = Question(self, motion, range, tolerance, alpha, tube, waypoints)
        question.set_options(options)

        def result(finding: Any) -> Paving:
            return Paving(finding, question.texts.notes)

        text = question.texts.of(resolution, "resolution")
        proof = proof_of(certificate, shard_size)
        try:
            return result(_regulus.locate(question.question, question.options, text, *proof))
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def check_load(
        self,
        motion: str = "",
        load: str = "",
        *,
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> LoadCheck:
        """Proves that at every pose forces within the limits of the model hold a load.

        Args:
            load: the set of wrenches, of those in `loads`; "" if the robot has only one.

        The others and the errors are as for check(); of the options, threads, time_limit, max_boxes,
        engine, isa and use_cache have an effect. The `result` of an interrupt is a LoadCheck.
        """
        question = Question(self, motion, range, tolerance, None, tube, waypoints)
        question.set_options(options)

        def result(finding: Any) -> LoadCheck:
            return LoadCheck(question, finding, question.texts.notes)

        proof = proof_of(certificate, shard_size)
        try:
            return result(
                _regulus.check_load(
                    question.question, text_of("load", load), question.options, *proof
                )
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def locate_load(
        self,
        motion: str = "",
        load: str = "",
        *,
        resolution: Number = "",
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> LoadPaving:
        """Paves a motion with boxes in which a load is held everywhere, nowhere, or undecided.

        Arguments and errors are as for check_load() and locate(), also along way-points; the
        `result` of an interrupt is a LoadPaving.
        """
        require_package("numpy", "locate_load()")
        question = Question(self, motion, range, tolerance, tube=tube, waypoints=waypoints)
        question.set_options(options)

        def result(finding: Any) -> LoadPaving:
            return LoadPaving(finding, question.texts.notes)

        text_of("load", load)
        text = question.texts.of(resolution, "resolution")
        proof = proof_of(certificate, shard_size)
        try:
            return result(
                _regulus.locate_load(question.question, load, question.options, text, *proof)
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def margin(
        self,
        motion: str = "",
        *,
        tolerance: Union[None, str, Mapping[str, Any]] = None,
        alpha: Any = None,
        scale: Any = None,
        grow: Optional[Mapping[str, Any]] = None,
        gap: Number = "0.01",
        range: Optional[Mapping[str, Range]] = None,
        quantity: str = "",
        limit: Optional[Number] = None,
        load: str = "",
        twist: str = "",
        leg: Union[str, int] = "",
        freedom: str = "",
        least: bool = False,
        signed: bool = False,
        tube: Union[None, Range, Mapping[str, Range]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> Margin:
        """Brackets the largest safe tolerance, threshold or size of a motion.

        With a quantity and a limit, it brackets the largest at which the quantity keeps the limit.
        Exactly one of the first four, or of `tube`, is asked:

        Args:
            tolerance: groups: "base,platform", or {"base,platform": (lower, upper)}. Other entries
                of the dict with one number are tolerances that stay.
            alpha: (lower, upper) of the threshold.
            scale: (lower, upper) of the factor of the motion's ranges about their middles.
            grow: {"R": (lower, upper)}: the parameter R of the motion, whose range grows from its
                declared low end.
            tube: (lower, upper) of the control errors of all pose parameters, or {"x,y": (lower, upper)}
                of those named; numbers are errors that stay.
            gap: the bracket (a, b) is closed when (b - a)/b is at most this.
            quantity: what must keep the limit, as for bound(), with load, twist, leg, freedom,
                least and signed.
            limit: every value is below it; with `least`, and of sigma-min and determinant, above.
            certificate: FILE; the proofs are FILE.safe and FILE.singular, of a leg FILE.leg_3.safe.
            shard_size: of each proof, as for check().

        An upper end of None is looked for. The default of `time_limit` is 60 seconds. The others
        and the errors are as for check(); the `result` of an interrupt is a Margin.
        """
        if isinstance(tolerance, str):
            tolerance = {tolerance: (0, None)}
        tolerance = mapping_of("tolerance", tolerance)
        asked = {k: v for k, v in tolerance.items() if elements_of(v) is not None}
        fixed = {k: v for k, v in tolerance.items() if k not in asked}
        tubes = tube if isinstance(tube, Mapping) else {} if tube is None else {"": tube}
        asked_tubes = {k: v for k, v in tubes.items() if elements_of(v) is not None}
        fixed_tubes: Mapping[str, Any] = {k: v for k, v in tubes.items() if k not in asked_tubes}
        question = Question(self, motion, range, fixed, None, fixed_tubes, waypoints)
        question.set_options({"time_limit": 60, **options})
        of = question.texts.of

        def bracket(name: str, ends: Any) -> str:
            if ends is None:
                return ""
            pair = elements_of(ends)
            if pair is None or len(pair) != 2:
                raise UsageError(f"{name}: found {ends!r}; give (lower, upper)")
            return f"{of(pair[0], name)}:{'' if pair[1] is None else of(pair[1], name)}"

        def result(finding: Any) -> Margin:
            return Margin(question, finding, question.texts.notes)

        if len(asked_tubes) > 1:
            raise UsageError("margin: several tubes are asked; join their parameters: 'x,y'")
        growing_tube = "".join(
            (f"{names}=" if names else "") + bracket(f"tube: {names}" if names else "tube", ends)
            for names, ends in asked_tubes.items()
        )
        if len(asked) > 1:
            raise UsageError("margin: several tolerances are asked; join their groups: 'a,b'")
        if grow is not None and len(mapping_of("grow", grow)) != 1:
            raise UsageError("margin: grow names one parameter: {'R': (lower, upper)}")
        growing = "".join(f"{name}={bracket(f'grow: {name}', ends)}" for name, ends in (grow or {}).items())
        tolerances = "".join(f"{groups}={bracket(f'tolerance: {groups}', ends)}" for groups, ends in asked.items())
        try:
            return result(
                _regulus.margin(
                    question.question,
                    question.options,
                    tolerances,
                    bracket("alpha", alpha),
                    bracket("scale", scale),
                    growing,
                    of(gap, "gap"),
                    _quantity(quantity, load, twist, leg, freedom, least, signed),
                    "" if limit is None else of(limit, "limit"),
                    *proof_of(certificate, shard_size),
                    growing_tube,
                )
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def bound(
        self,
        motion: str = "",
        quantity: str = "",
        *,
        load: str = "",
        twist: str = "",
        leg: Union[str, int] = "",
        freedom: str = "",
        least: bool = False,
        signed: bool = False,
        norm: Union[str, int] = "",
        finite: bool = False,
        limit: Optional[Number] = None,
        gap: Number = "0.01",
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        waypoints: Optional[Path] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> Bound:
        """Brackets the largest value of a quantity over a motion, or compares it with a limit.

        Args:
            quantity: "force", "error", "speed", "sigma-min", "sigma-max", "condition", "deflection",
                "determinant", "determinant-max", or an expression of the model.
            load: the set of wrenches, of those in `loads`.
            twist: the set of twists, of those in `twists`.
            leg: the number of a leg, from 1; "" for all.
            freedom: of an error or a deflection: the name of a column, "position" or "rotation".
            least: the least value, with its sign.
            signed: the largest value with its sign, not the largest absolute value.
            norm: of a condition number: 2, the largest singular value divided by the least, or "max".
            finite: the errors of a closure's unknowns, or of a platform on telescopic legs, all
                the way, not to first order.
            limit: compare with this value.
            gap: the bracket is closed when it is at most this part of its larger end.
            certificate: FILE; the proofs are FILE.safe and FILE.singular, of a leg FILE.leg_3.safe.
            shard_size: of each proof, as for check().

        The default of `time_limit` is 60 seconds. The others and the errors are as for check(); the
        `result` of an interrupt is a Bound.
        """
        question = Question(self, motion, range, tolerance, None, tube, waypoints)
        question.set_options({"time_limit": 60, **options})
        of = question.texts.of

        def result(finding: Any) -> Bound:
            return Bound(question, finding, question.texts.notes)

        try:
            return result(
                _regulus.bound(
                    question.question,
                    question.options,
                    _quantity(quantity, load, twist, leg, freedom, least, signed, norm, finite),
                    "" if limit is None else of(limit, "limit"),
                    of(gap, "gap"),
                    *proof_of(certificate, shard_size),
                )
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def solve(
        self,
        motion: str = "",
        *,
        at: Optional[Mapping[str, Number]] = None,
        hold: Sequence[str] = (),
        tolerance: Optional[Mapping[str, Number]] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        certificate: Optional[Path] = None,
        **options: Unpack[Options],
    ) -> Solved:
        """Finds all configurations, poses or postures at one place, and proves that these are all.

        Args:
            motion: one that has one place; "" if the robot has only one, or `at` gives all numbers.
            at: values of pose parameters; in their place of the legs' lengths, rho_1, rho_2 and so
                on, or of the tool, x, y, z, roll, pitch, yaw; in their units.
            hold: joints of an arm that keep the values of the place, where more than six move.
            tolerance: as for check().
            tube: the control error of numbers of the place: {"x": 0.001}, or one number for all.
            certificate: a file for the proof.
            options: of the search: threads, time_limit, max_boxes, engine, isa, use_cache,
                beyond_limits.

        The default of `time_limit` is 60 seconds. Errors are as for check(); the `result` of an
        interrupt is a Solved.
        """
        require_package("numpy", "solve()")
        question = Question(self, motion, None, tolerance, tube=tube)
        question.set_options({"time_limit": 60, **options})
        given = assignments_of("at", at, question.texts)
        held = words_of("hold", hold)
        proof = optional_path("certificate", certificate)

        def result(finding: Any) -> Solved:
            return Solved(question, finding, question.texts.notes)

        try:
            return result(
                _regulus.solve(question.question, question.options, given, held, proof)
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def solve_many(
        self,
        motion: str = "",
        *,
        at: Optional[Mapping[str, Union[Number, Numbers]]] = None,
        waypoints: Optional[Path] = None,
        hold: Sequence[str] = (),
        tolerance: Optional[Mapping[str, Number]] = None,
        tube: Union[None, Number, Mapping[str, Number]] = None,
        certificate: Optional[Path] = None,
        shard_size: int = 0,
        **options: Unpack[Options],
    ) -> SolvedPlaces:
        """Solves many places, each for itself.

        Args:
            at: as for solve(), with lists or arrays of NumPy, which have a number for each place; a
                single number is that of all places.
            waypoints: a table of places, one a line, in the place of lists. Without both, the
                places are the way-points of the motion.
            certificate: a file for the proofs at all places.
            shard_size: as for check(); it is cut between places.

        Limits of the search are those of each place. The others and the errors are as for solve();
        the `result` of an interrupt is a SolvedPlaces.
        """
        require_package("numpy", "solve_many()")
        question = Question(self, motion, None, tolerance, tube=tube)
        question.set_options({"time_limit": 60, **options})
        given = mapping_of("at", at)
        columns = {name: elements_of(value) for name, value in given.items()}
        single = {name: given[name] for name, list_of in columns.items() if list_of is None}
        lists = {name: list_of for name, list_of in columns.items() if list_of is not None}
        if lists and waypoints is not None:
            raise UsageError(
                "solve_many: give the places by lists or arrays in at, or by a table in waypoints"
            )
        everywhere = assignments_of("at", single, question.texts)
        held = words_of("hold", hold)
        places = places_of("at", lists, question.texts)

        def result(finding: Any) -> SolvedPlaces:
            return SolvedPlaces(question, finding, question.texts.notes)

        table = optional_path("waypoints", waypoints)
        proof = proof_of(certificate, shard_size)
        try:
            return result(
                _regulus.solve_many(
                    question.question, question.options, everywhere, held, places, table, *proof
                )
            )
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def prepare(
        self,
        motion: str = "",
        *,
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        alpha: Optional[Number] = None,
        **options: Unpack[Options],
    ) -> Prepared:
        """Forms and compiles the functions of a motion once, for many checks.

        Arguments and errors as for check(), without way-points.
        """
        return Prepared(self, motion, range, tolerance, alpha, options)

    def write(self, path: Path) -> None:
        """Writes the model file: the whole of it, or nothing. Raises FileError."""
        _regulus.write_file(os.fsencode(path_of("path", path)), self.text)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Robot) and (self.text, self.path) == (other.text, other.path)

    def __hash__(self) -> int:
        return hash((self.text, self.path))

    def __repr__(self) -> str:
        return f"<Robot {self.name!r}: {', '.join(self.motions) or 'no motion'}>"

    def _repr_html_(self) -> str:
        from .results import _table

        rows = [(name, ", ".join(parameters)) for name, parameters in self.motions.items()]
        return _table(self.name, "", rows)


class Prepared:
    """A motion whose functions are formed and compiled.

    It can be copied and pickled; the copy is prepared again, which the cache makes short.
    """

    def __init__(
        self,
        robot: Robot,
        motion: str,
        range: Optional[Mapping[str, Range]],
        tolerance: Optional[Mapping[str, Number]],
        alpha: Optional[Number],
        options: Mapping[str, Any],
    ) -> None:
        self.robot = robot
        self.motion = motion
        self._range = range
        self._tolerance = tolerance
        self._alpha = alpha
        self._options = dict(options)
        self._limits: dict[str, Any] = {
            name: option_of(name, self._options.get(name) or 0)
            for name in ("max_boxes", "time_limit", "threads")
        }
        question = Question(robot, motion, range, tolerance, alpha)
        question.set_options(self._options)
        self._prepared = _regulus.prepare(question.question, question.options)

    def check(
        self,
        *,
        range: Optional[Mapping[str, Range]] = None,
        tolerance: Optional[Mapping[str, Number]] = None,
        alpha: Optional[Number] = None,
        max_boxes: Optional[int] = None,
        time_limit: Optional[float] = None,
        threads: Optional[int] = None,
    ) -> PreparedCheck:
        """Checks the motion with these ranges, tolerances and threshold, or with those of prepare().

        A tolerance or a range that the motion did not have makes other functions necessary; they
        are prepared first, and kept as well. The verdict is about the question that is asked. The
        number of boxes may differ from that of Robot.check(), which forms its functions for its own
        ranges. Errors as for Robot.check().
        """
        question = Question(
            self.robot,
            self.motion,
            {**(self._range or {}), **mapping_of("range", range)},
            {**(self._tolerance or {}), **mapping_of("tolerance", tolerance)},
            self._alpha if alpha is None else alpha,
        )
        limits = dict(self._limits)
        given = {"max_boxes": max_boxes, "time_limit": time_limit, "threads": threads}
        limits.update({n: option_of(n, value) for n, value in given.items() if value is not None})

        def result(finding: Any) -> PreparedCheck:
            return PreparedCheck(question, finding, question.texts.notes, self._prepared, limits)

        try:
            return result(self._prepared.check(question.question, **limits))
        except KeyboardInterrupt as stop:
            _with_partial(stop, result)
            raise

    def __getstate__(self) -> tuple[Any, ...]:
        changes = (self._range, self._tolerance, self._alpha)
        return (self.robot, self.motion, *changes, self._options)

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.__init__(*state)  # type: ignore[misc]

    def __copy__(self) -> Prepared:
        return Prepared(*self.__getstate__())

    def __deepcopy__(self, memo: dict[int, Any]) -> Prepared:
        return self.__copy__()

    def __repr__(self) -> str:
        return f"<Prepared {self.robot.name!r}, {self.motion or 'its motion'}>"


def _model_folders() -> list[str]:
    package = os.path.dirname(os.path.abspath(__file__))
    named = os.environ.get("REGULUS_MODELS")
    if named:
        return [named]
    # As built, in a wheel, and as installed in a system.
    found = os.path.dirname(os.path.abspath(_regulus.__file__))
    return [
        os.path.join(found, "../../share/regulus/models"),
        os.path.join(package, "models"),
        os.path.join(package, "../../../../share/regulus/models"),
    ]


def models() -> list[str]:
    """The names of the installed models, which load() takes."""
    names = {
        entry[: -len(".toml")]
        for folder in _model_folders()
        if os.path.isdir(folder)
        for entry in os.listdir(folder)
        if entry.endswith(".toml")
    }
    return sorted(name for name in names if name.isidentifier())


def _find_model(name: str) -> str:
    if os.path.exists(name) or not name.isidentifier():
        return name
    for folder in _model_folders():
        path = os.path.join(folder, name + ".toml")
        if os.path.exists(path):
            return os.path.normpath(path)
    near = difflib.get_close_matches(name, models(), 1)
    hint = f"did you mean {near[0]!r}?" if near else "regulus.models() names the installed models"
    raise FileError(f"there is no file {name!r}, and no installed model of that name; {hint}")


def load(path: Path) -> Robot:
    """Reads a model file, or the installed model of that name, such as "robot_1".

    Raises:
        FileError: if there is no such file; InputError: with file and line.
    """
    found = _find_model(path_of("path", path))
    try:
        with open(found, "rb") as file:
            # One byte more than allowed, so that it is refused in terms of the model.
            text = file.read(_LARGEST_MODEL + 1).decode("utf-8")
    except UnicodeDecodeError as error:
        raise FileError(f"cannot read {found!r}: it is not UTF-8") from error
    except OSError as error:
        raise FileError(f"cannot read {found!r}: {error.strerror}") from error
    return Robot(text, found)


def verify(
    path: Path,
    *,
    model: Optional[Path] = None,
    waypoints: Optional[Path] = None,
    threads: int = 1,
    time_limit: float = 0,
    max_boxes: int = 0,
    allow_options: bool = False,
) -> Verification:
    """Proves the claim of a certificate again, by separate code.

    Args:
        path: the certificate.
        model: a model file; the certificate must be about it.
        waypoints: the file of way-points that check() took.
        time_limit: in seconds; 0: none.
        max_boxes: into which leaves may be cut; 0: the default of `regulus verify`.
        allow_options: ranges, tolerances, alpha and larger control errors may differ from the model,
            because options change them; `json["differences"]` lists them.

    Raises:
        FileError: if a file cannot be read; InputError: for the model file.
    """
    return Verification(
        _regulus.verify(
            path_of("path", path),
            optional_path("model", model),
            optional_path("waypoints", waypoints),
            count_of("threads", threads, 1, 1024),
            seconds_of("time_limit", time_limit),
            count_of("max_boxes", max_boxes),
            bool(allow_options),
        )
    )


def from_urdf(
    path: Path,
    *,
    base: str = "",
    tip: str = "",
    cuts: Sequence[str] = (),
    welds: Sequence[str] = (),
    actuated: Sequence[str] = (),
    at: Sequence[str] = (),
    closure: bool = False,
    snap: Number = "1e-8",
) -> Robot:
    """Reads a URDF, MJCF or SDF file as a robot: an arm, a platform on legs, or any robot with loops.

    Args:
        base: the first link of the chain; "" if only one can be meant.
        tip: the last link.
        cuts: "LINK=LINK": points that coincide in loops which the file does not have.
        welds: the same for frames.
        actuated: driven joints of a robot with loops; empty: the usual ones.
        at: "JOINT=VALUE": from where loops are closed that the file's pose leaves open.
        closure: writes the equations of loops for robots that have legs, too.
        snap: numbers move by at most this much to short decimals and multiples of π/12.

    `text` is a model file that can be read and kept; `notes` say what was assumed.

    Raises:
        InputError: with file and line; UsageError; FileError.
    """
    model, report = _regulus.import_file(
        path_of("path", path),
        text_of("base", base),
        text_of("tip", tip),
        words_of("cuts", cuts),
        words_of("welds", welds),
        words_of("actuated", actuated),
        words_of("at", at),
        bool(closure),
        Texts().of(snap, "snap"),
    )
    return Robot(model, notes=report.splitlines())
