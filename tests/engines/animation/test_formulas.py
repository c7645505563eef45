"""The formula language of animation files."""

import math
import operator
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reactive_realizer.embodiment.vector import Vec3
from reactive_realizer.engines.animation.expression.compiler import compile_formulas
from reactive_realizer.engines.animation.expression.functions import (
    FUNCTIONS,
    Function,
    PerlinNoise,
    hermite,
    noise,
    perlin,
    plugin_functions,
    tcbspline,
)
from reactive_realizer.engines.animation.expression.syntax import LONGEST, parse, variables
from reactive_realizer.errors import RealizerError


def value(text: str, **names: float) -> float:
    (result,) = compile_formulas([parse(text)], list(names))(*names.values())
    return result


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("8 / 4 / 2", 1.0),
        ("2 - 3 - 4", -5.0),
        ("2 ^ 3 ^ 2", 512.0),
        ("-3 ^ 2", -9.0),
        ("2 ^ -1", 0.5),
        ("2 * -3", -6.0),
        ("--2", 2.0),
        (".5 + 1e-1 + 2.", 2.6),
        ("1 < 2", 1.0),
        ("2 + 1 <= 2", 0.0),
        ("1 == 1", 1.0),
        ("1 != 1", 0.0),
        ("3 > 2 > 0.5", 1.0),
        ("if(0, 1, 2)", 2.0),
        ("if(-1, 1, 2)", 2.0),
        ("if(0.1, 1, 2)", 1.0),
        ("max(1, 3, 2) - min(4, 2)", 1.0),
        ("sin(pi / 2) + cos(0)", 2.0),
        ("atan2(1, 0) * 2", math.pi),
        ("log(e) + exp(0) + sqrt(9) + abs(-1)", 6.0),
        ("floor(-1.5)", -2.0),
        ("ceil(1.2) + round(2.5) + round(-2.6)", 2.0),
        ("ln(e) + log10(100)", 3.0),
        ("tanh(atanh(0.5)) + sinh(asinh(2)) + cosh(acosh(3))", 5.5),
        ("7 % 4 + 2 * 3 % 4", 5.0),
        ("mod(-7, 4)", -3.0),
        ("1 < 2 && 3 < 4", 1.0),
        ("1 < 2 && 3 < 2", 0.0),
        ("0 || 2", 1.0),
        ("1 || 0 && 0", 1.0),
        ("1 + 1 == 2 && !(1 > 2)", 1.0),
        ("!3 + !0", 1.0),
        ("if(1 < 2 || 0, 5, 6)", 5.0),
    ],
)
def test_a_formula_means_what_it_does_in_mathematics(text: str, expected: float) -> None:
    assert value(text) == pytest.approx(expected)


def test_names_are_variables_unless_they_are_pi_or_e() -> None:
    assert list(variables(parse("a * sin(2 * pi * r * t) + e"))) == ["a", "r", "t"]


def test_only_the_chosen_branch_is_evaluated() -> None:
    assert value("if(t == 0, 1, sin(t) / t)", t=0.0) == 1.0


def test_a_constant_without_a_value_fails_only_when_it_is_evaluated() -> None:
    assert value("if(t < 1, 0, 1 / 0)", t=0.5) == 0.0
    with pytest.raises(ZeroDivisionError):
        value("if(t < 1, 0, 1 / 0)", t=1.5)


@pytest.mark.parametrize(
    "text", ["(-8) ^ (1 / 3)", "log(0 * t)", "9 ^ 9 ^ 9", "exp(1000)", "1 / (t - t)", "floor(1e999)"]
)
def test_a_formula_without_a_value_raises_an_arithmetic_or_value_error(text: str) -> None:
    with pytest.raises((ArithmeticError, ValueError)):
        value(text, t=0.5)


def test_equal_formulas_are_evaluated_once() -> None:
    formulas = [parse("t + 1"), parse("t+1"), parse("2 * t")]
    assert compile_formulas(formulas, ["t"])(3.0) == (4.0, 4.0, 6.0)


BINARY = {"+": operator.add, "-": operator.sub, "*": operator.mul, "<": operator.lt, ">=": operator.ge}


@st.composite
def formula(draw: st.DrawFn, depth: int = 4) -> tuple[str, float]:
    """A formula and its value in Python for t = 0.25."""
    if depth == 0 or draw(st.booleans()):
        if draw(st.booleans()):
            return "t", 0.25
        number = draw(st.floats(0, 100, allow_nan=False).map(lambda x: round(x, 3)))
        return repr(number), number
    kind = draw(st.sampled_from([*BINARY, "negation", "if", "sin", "max"]))
    a, x = draw(formula(depth=depth - 1))
    b, y = draw(formula(depth=depth - 1))
    if kind == "negation":
        return f"(-{a})", -x
    if kind == "if":
        return f"if({a} > {b}, {a}, {b})", x if x > y else y
    if kind == "sin":
        return f"sin({a})", math.sin(x)
    if kind == "max":
        return f"max({a}, {b})", max(x, y)
    return f"({a} {kind} {b})", float(BINARY[kind](x, y))


@settings(derandomize=True)
@given(formula())
def test_any_formula_has_the_value_that_python_computes(case: tuple[str, float]) -> None:
    text, expected = case
    assert float(value(text, t=0.25)) == expected


@pytest.mark.parametrize(
    ("text", "reason", "at"),
    [
        ("", "it ends unexpectedly", 1),
        ("1 +", "it ends unexpectedly", 4),
        ("1 + * 2", "'*' instead of a number or a name", 5),
        ("(1 + 2", "')' is missing", 7),
        ("sin(1", "')' is missing", 6),
        ("1 2", "'2' instead of an operator", 3),
        ("2t", "'t' instead of an operator", 2),
        ("sin()", "')' instead of a number or a name", 5),
        ("sin(1, 2)", "sin takes 1, not 2", 1),
        ("if(1, 2)", "if takes 3 arguments", 1),
        ("1 + sinn(t)", "unknown function 'sinn'; known are if, abs", 5),
        ("hermite(t, 0, 0, 1)", "hermite takes x, two speeds and 2 points or more, not 4", 1),
        ("tcbspline(t,0,0, 0,0, 1,0.5,0,0, 1,1)", "tcbspline takes t, two speeds", 1),
        ("t & 1", "'&' is not allowed here", 3),
        ("t && ", "it ends unexpectedly", 6),
        ("a.b", "'.' is not allowed here", 2),
        ("t # comment", "'#' is not allowed here", 3),
        ("1" + "+1" * LONGEST, "more than 20000 characters", LONGEST + 1),
        ("(" * 200 + "t" + ")" * 200, "nested deeper than 80", 82),
        ("-" * 200 + "t", "nested deeper than 80", 82),
        ("t" + "+t" * 200, "nested deeper than 80", 162),
        ("1" + "^1" * 200, "nested deeper than 80", 163),
    ],
)
def test_an_invalid_formula_is_reported_with_reason_and_position(text: str, reason: str, at: int) -> None:
    with pytest.raises(RealizerError) as with_reached_root:
        parse(text)
    fault = with_reached_root.value.fault
    assert fault.code == "bad-expression"
    assert str(fault.details["reason"]).startswith(reason)
    assert fault.details["at"] == at


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "(1).__class__",
        "open(t)",
        "eval(t)",
        "[].x",
        "lambda: 1",
        "t if t else t",
        "t; t",
        "'t'",
        "{t}",
    ],
)
def test_a_formula_cannot_reach_python(text: str) -> None:
    with pytest.raises(RealizerError):
        parse(text)


@pytest.mark.parametrize("name", ["class", "None", "__builtins__", "_sin", "p0", "r0", "exec"])
def test_names_of_python_are_ordinary_variables(name: str) -> None:
    assert value(f"{name} + 1", **{name: 2.0}) == 3.0


@pytest.mark.parametrize("depth", [79, 40])
def test_the_deepest_formula_that_is_parsed_can_be_compiled(depth: int) -> None:
    assert value("sin(" * depth + "t" + ")" * depth, t=0.0) == 0.0
    assert value("t" + "+t" * depth, t=1.0) == depth + 1
    assert value("if(1," * depth + "t" + ",0)" * depth, t=3.0) == 3.0


number = st.floats(-2.0, 2.0)


@settings(derandomize=True)
@given(st.lists(number, min_size=2, max_size=8), number, number)
def test_a_hermite_curve_has_its_points_and_end_slopes(points: list[float], start: float, end: float) -> None:
    last = len(points) - 1
    assert [hermite(float(i), start, end, *points) for i in range(len(points))] == pytest.approx(points)
    step = 1e-6
    assert (hermite(step, start, end, *points) - points[0]) / step == pytest.approx(start, abs=1e-3)
    assert (points[-1] - hermite(last - step, start, end, *points)) / step == pytest.approx(end, abs=1e-3)


@settings(derandomize=True)
@given(st.lists(number, min_size=3, max_size=8), st.integers(1, 6))
def test_a_hermite_curve_is_smooth(points: list[float], i: int) -> None:
    i = min(i, len(points) - 2)
    step = 1e-6
    before = (points[i] - hermite(i - step, 0.0, 0.0, *points)) / step
    after = (hermite(i + step, 0.0, 0.0, *points) - points[i]) / step
    assert before == pytest.approx(after, abs=1e-3)


def flat_keys(values: list[float], times: list[float], shape: tuple[float, float, float]) -> list[float]:
    keys = [values[0], times[0]]
    for v, t in zip(values[1:-1], times[1:-1], strict=True):
        keys += [v, t, *shape]
    return [*keys, values[-1], times[-1]]


shape = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))


@settings(derandomize=True)
@given(st.lists(number, min_size=2, max_size=6), shape)
def test_a_tcb_curve_passes_its_keys_with_any_tension_continuity_and_bias(values: list[float], shape: Vec3) -> None:
    times = [0.1 * i + 0.02 * i * i for i in range(len(values))]
    keys = flat_keys(values, times, shape)
    assert [tcbspline(t, 0.0, 0.0, *keys) for t in times] == pytest.approx(values)
    assert tcbspline(-1.0, 0.0, 0.0, *keys) == values[0]
    assert tcbspline(9.0, 0.0, 0.0, *keys) == values[-1]


@settings(derandomize=True)
@given(st.lists(number, min_size=3, max_size=6), st.floats(-1, 1), st.floats(-1, 1))
def test_a_tcb_curve_with_full_continuity_is_smooth_at_unequal_intervals(
    values: list[float], tension: float, bias: float
) -> None:
    times = [0.1 * i + 0.05 * i * i for i in range(len(values))]
    keys = flat_keys(values, times, (tension, 0.0, bias))
    step = 1e-7
    before = (values[1] - tcbspline(times[1] - step, 0.0, 0.0, *keys)) / step
    after = (tcbspline(times[1] + step, 0.0, 0.0, *keys) - values[1]) / step
    assert before == pytest.approx(after, abs=2e-2)


def test_reduced_continuity_makes_a_corner() -> None:
    keys = flat_keys([0.0, 1.0, 0.0], [0.0, 0.5, 1.0], (0.0, -1.0, 0.0))
    assert tcbspline(0.499, 0.0, 0.0, *keys) < 0.999
    assert tcbspline(0.499, 0.0, 0.0, *flat_keys([0.0, 1.0, 0.0], [0.0, 0.5, 1.0], (0.0, 0.0, 0.0))) > 0.9999


@settings(derandomize=True)
@given(st.integers(0, 1000), st.floats(-300.0, 300.0))
def test_noise_stays_within_1_and_is_0_at_integers(seed: int, x: float) -> None:
    wave = PerlinNoise(seed)
    assert -1.0 <= wave(x) <= 1.0
    assert wave(float(math.floor(x))) == pytest.approx(0.0, abs=1e-9)


def test_noise_is_smooth() -> None:
    wave, step = PerlinNoise(5), 0.01
    values = [wave(-3.0 + step * i) for i in range(1001)]
    speeds = [(after - before) / step for before, after in pairwise(values)]
    accelerations = [(after - before) / step for before, after in pairwise(speeds)]
    assert max(map(abs, speeds)) < 4.0
    assert max(map(abs, accelerations)) < 20.0


def test_noise_depends_on_its_seed_only() -> None:
    values = [[PerlinNoise(seed)(0.37 * i) for i in range(100)] for seed in (1, 1, 2)]
    assert values[0] == values[1] != values[2]
    assert max(values[0]) > 0.3
    assert min(values[0]) < -0.3


@settings(derandomize=True)
@given(st.floats(-100.0, 100.0), st.integers(1, 8), st.floats(0.0, 2.0))
def test_octaves_add_faster_waves_and_stay_within_1(x: float, count: int, persistence: float) -> None:
    assert -1.0 <= perlin(x, float(count), persistence) <= 1.0
    assert perlin(x, float(count), 0.0) == perlin(x, 1.0)


@settings(derandomize=True)
@given(st.floats(-20.0, 20.0), st.integers(1, 12))
def test_the_noise_of_published_files_repeats_after_its_number_of_points(x: float, points: int) -> None:
    assert noise(x, float(points)) == pytest.approx(noise(x + points, float(points)), abs=1e-6)
    assert -0.2 <= noise(x, float(points)) <= 1.2


@pytest.mark.parametrize("text", ["noise(t, 0)", "noise(t, 300)", "perlin(t, 0)", "perlin(t, 1e9)", "perlin(t, 2, -1)"])
def test_noise_with_invalid_arguments_has_no_value(text: str) -> None:
    with pytest.raises(ValueError, match="noise"):
        value(text, t=0.5)


def wobble(x: float, strength: float = 2.0) -> float:
    if x < 0.0:
        raise LookupError("only ahead")
    return strength * x


OURS = {**FUNCTIONS, "wobble": Function.of("wobble", wobble)}


def test_a_formula_may_call_a_function_of_a_plug_in() -> None:
    (result,) = compile_formulas([parse("wobble(t) + wobble(t, 3)", OURS)], ["t"])(0.5)
    assert result == 2.5


def test_a_plug_in_function_takes_as_many_numbers_as_in_python() -> None:
    with pytest.raises(RealizerError, match=r"wobble takes \(x: float, strength: float = 2.0\) -> float, not 3"):
        parse("wobble(1, 2, 3)", OURS)


def test_a_failing_plug_in_function_has_no_value() -> None:
    with pytest.raises(ValueError, match="wobble: only ahead"):
        compile_formulas([parse("wobble(t)", OURS)], ["t"])(-1.0)


@pytest.mark.parametrize("name", ["sin", "if"])
def test_a_plug_in_cannot_redefine_a_function_of_the_language(name: str) -> None:
    with pytest.raises(RealizerError, match=f"'{name}' in the plug-in group functions is defined more than once"):
        plugin_functions({name: wobble})
