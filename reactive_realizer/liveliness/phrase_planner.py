"""Plans how a speaker moves with a phrase: from its accents, its words and its place in the turn.

The evidence: head movements coincide with pitch accents and the borders of phrases (H. P. Graf, E. Cosatto, V. Strom
and F. J. Huang, "Visual prosody: facial movements accompanying speech", 2002); brows rise with accents (C. Cave and
others, "About the relationship between eyebrow movements and F0 variations", 1996), a little before them (M. L.
Flecha-Garcia, "Eyebrow raises in dialogue and their relation to discourse structure, utterance function and pitch
accents in English", 2010); speakers look away as they begin a turn and hesitate, and back as they end it (A. Kendon,
"Some functions of gaze-direction in social interaction", 1967); blinks come with pauses (T. Nakano and S. Kitazawa,
"Eyeblink entrainment at breakpoints of speech", 2010). Amounts, spacings and shares are our choice.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from random import Random
from typing import Final

from reactive_realizer.liveliness.movement import SOONEST, Anchor, Movement
from reactive_realizer.liveliness.prosody import Phrase, SpokenWord
from reactive_realizer.liveliness.word_classes import WordBehavior, WordClasses
from reactive_realizer.planunit.body_parts import BodyPart

Busy = Callable[[Movement], bool]
"""Whether something that was asked for moves the same part of the body meanwhile."""

USUAL: Final = 0.5
"""The liveliness for which the amounts are."""

_GAPS: Final = {BodyPart.HEAD: 0.05, BodyPart.FACE: 0.6, BodyPart.ARMS: 1.5, BodyPart.EYES: 0.8}
"""Least time between two movements of a part, s, with the usual liveliness."""

_BEFORE: Final = {"head": 0.35, "gesture": 0.7, "faceLexeme": 0.2, "gaze": 0.15}
_AFTER: Final = {"head": 0.35, "gesture": 0.9, "faceLexeme": 0.7, "gaze": 0.6}
"""Time that a movement for a word takes before and after the accent, s."""

_ACCENT: Final = 0.7
"""Prominence of an accented word, with no liveliness; with liveliness, less is enough."""

_STRONG: Final = 0.85
"""Prominence of a word for which brows rise and hands beat."""

_POSE: Final = {"LEFT": 0.058, "TILT_LEFT": 0.15, "UP": 0.05}
"""The largest amounts with which the head takes another position for a phrase: by 2.3, 3.8 and 1.4 degrees."""
_SIDE: Final = {"LEFT": 2, "TILT_LEFT": 1, "UP": 1}
"""After how many phrases the head takes positions on the other side."""
_TURNING: Final = 0.5
"""The shortest time in which the head takes such a position in full, s; if a phrase leaves less, it goes less far."""
_OPPOSITE: Final = {"LEFT": "RIGHT", "TILT_LEFT": "TILT_RIGHT", "UP": "DOWN"}

_NODS: Final = (("NOD", 0.26), ("NOD", 0.22), ("TILT_FORWARD", 0.22), ("TOSS", 0.11))
"""Head movements for accents, with the amounts for the greatest prominence."""

_AWAY: Final = ("UPLEFT", "UPRIGHT", "LEFT", "RIGHT", "DOWNLEFT", "DOWNRIGHT")
_LONG_TURN: Final = 6
"""Words of a turn at the beginning of which a speaker looks away."""
_PAUSE: Final = 0.2
"""The shortest pause in which a speaker blinks or looks away, s."""
_BLINKING: Final = 0.7
"""Share of the pauses in which a speaker blinks."""


class PhrasePlanner:
    """Plans the movements of one speech, phrase by phrase.

    Args:
        classes: of words.
        seed: of its random choices.
        listener: what the speaker looks away from; None if that is unknown.
    """

    def __init__(self, classes: WordClasses, seed: str, listener: str | None) -> None:
        self._classes = classes
        self._seed = seed
        self._listener = listener
        self._planned: dict[int, list[Movement]] = {}

    def plan(self, phrases: list[Phrase], index: int, liveliness: float, busy: Busy) -> list[Movement]:
        """The movements for a phrase, none of which is busy; none without liveliness.

        Args:
            phrases: of the speech; that of the index has the prominence of its words.
            index: of the phrase.
            liveliness: 0 to 1.
            busy: asked for each movement.
        """
        if liveliness <= 0.0:
            return []
        # Its own for each phrase: what is chosen for one does not depend on what was planned for others.
        random = Random(f"{self._seed}:{index}")
        factor = math.sqrt(liveliness / USUAL)
        added = (*self._poses(phrases, index, random), *_blinks(phrases[index], random))
        kept = [each for each in added if not busy(each)]
        before, moves = self._planned.get(index - 1, []), list[Movement]()
        for each in self._moves(phrases, index, liveliness, random):
            if not (busy(each) or any(each.disturbs(other, self._gap(each)) for other in (*before, *moves))):
                moves.append(each)
        self._planned = {index - 1: before, index: moves}
        return [each.scaled(factor) for each in (*kept, *moves)]

    def _gap(self, movement: Movement) -> float:
        return max(_GAPS[part] for part in movement.parts)

    def _moves(self, phrases: list[Phrase], index: int, liveliness: float, random: Random) -> Iterator[Movement]:
        """Movements in the order of precedence; those that are too near to earlier ones of their part are left out."""
        phrase = phrases[index]
        for found in self._classes.find(phrase.words):
            for behavior in found.kind.behaviors:
                if (made := self._for_word(behavior, found.word, phrase, index)) is not None:
                    yield made
        if phrase.sentence == "?":
            yield _during(phrase, "faceLexeme", {"lexeme": "RAISE_BROWS"}, 0.3)
        if phrase.item:
            yield _at(phrase.words[-1], "head", {"lexeme": _side("TILT", index)}, 0.12)
        threshold = _ACCENT - 0.5 * liveliness
        for word in sorted(phrase.words, key=lambda word: -word.prominence):
            if word.prominence >= threshold:
                lexeme, amount = random.choice(_NODS)
                yield _at(word, "head", {"lexeme": lexeme}, amount * word.prominence**2 * random.uniform(0.75, 1.0))
            if word.prominence >= _STRONG:
                yield _at(word, "faceLexeme", {"lexeme": "RAISE_BROWS"}, 0.3 * word.prominence)
                if index % 2 == 1:
                    yield _at(word, "gesture", {"lexeme": "BEAT"}, 0.5)
        yield from self._looks(phrases, index, random)

    def _looks(self, phrases: list[Phrase], index: int, random: Random) -> Iterator[Movement]:
        """Looks away at the beginning of a turn, and at the pauses between its sentences."""
        if self._listener is None:
            return
        phrase, away = phrases[index], {"offsetDirection": random.choice(_AWAY)}
        if index == 0 and sum(len(each.words) for each in phrases) >= _LONG_TURN:
            span = phrase.start, phrase.start + min(1.1, phrase.end - phrase.start)
            yield self._look(phrase.words[0], span, away)
        elif index + 1 < len(phrases) - 1 and phrase.pause >= _PAUSE and phrase.closing not in ",":
            span = phrase.end - 0.2, phrase.end + phrase.pause + 0.6
            yield self._look(phrase.words[-1], span, away)

    def _look(self, word: SpokenWord, span: tuple[float, float], direction: Mapping[str, str]) -> Movement:
        attributes = {"target": self._listener or "", "influence": "EYES", "offsetAngle": "12", **direction}
        anchors = {"start": Anchor.at(word, span[0]), "end": Anchor.at(word, span[1])}
        return Movement("gaze", attributes, None, anchors, span)

    def _poses(self, phrases: list[Phrase], index: int, random: Random) -> Iterator[Movement]:
        """The head takes another position for each phrase, and goes on to that of the next one."""
        phrase = phrases[index]
        first, last = phrase.words[0], phrase.words[-1]
        begin, until = max(SOONEST, phrase.start - 0.25), phrase.end + min(phrase.pause, 0.3) + 0.3
        ready = min(phrase.start + 0.4, (phrase.start + phrase.end) / 2)
        unhurried = min(1.0, max(0.0, ready - begin) / _TURNING)
        for lexeme in random.sample(sorted(_POSE), 2):
            chosen = lexeme if index // _SIDE[lexeme] % 2 else _OPPOSITE[lexeme]
            times = {
                "start": (first, begin),
                "ready": (first, ready),
                "relax": (last, max(phrase.end - 0.2, (phrase.start + phrase.end) / 2)),
                "end": (last, until),
            }
            anchors = {sync: Anchor.at(word, time) for sync, (word, time) in times.items()}
            amount = _POSE[lexeme] * random.uniform(0.7, 1.0) * unhurried
            yield Movement("head", {"lexeme": chosen}, amount, anchors, (begin, until))

    def _for_word(self, behavior: WordBehavior, word: SpokenWord, phrase: Phrase, index: int) -> Movement | None:
        """The movement for a word of a class; None for a look if it is unknown what is looked away from."""
        attributes = dict(behavior.attributes)
        if behavior.element == "gaze":
            if self._listener is None:
                return None
            attributes["target"] = self._listener
        side = _side("", index)
        for name, value in attributes.items():
            attributes[name] = value.replace("AWAY", f"UP{side}").replace("SIDE", side)
        if not behavior.rest:
            return _at(word, behavior.element, attributes, behavior.amount)
        span = max(phrase.start, word.start - 0.1), phrase.end + 0.3
        anchors = {"start": Anchor.at(word, span[0]), "end": Anchor.at(phrase.words[-1], span[1])}
        return Movement(behavior.element, attributes, behavior.amount, anchors, span, lasting=True)


def _side(name: str, number: int) -> str:
    """Left and right by turns, as a lexeme or a direction."""
    side = "LEFT" if number % 2 else "RIGHT"
    return f"{name}_{side}" if name else side


def _at(word: SpokenWord, element: str, attributes: Mapping[str, str], amount: float | None) -> Movement:
    """A movement with its stroke on the stressed vowel of a word; others are around it."""
    span = word.accent - _BEFORE[element], word.accent + _AFTER[element]
    if element in ("head", "gesture"):
        anchors = {"stroke": Anchor.at(word, word.accent)}
    else:
        anchors = {"start": Anchor.at(word, span[0]), "end": Anchor.at(word, span[1])}
    return Movement(element, attributes, amount, anchors, span)


def _during(phrase: Phrase, element: str, attributes: Mapping[str, str], amount: float) -> Movement:
    span = phrase.start - 0.1, phrase.end + 0.2
    anchors = {"start": Anchor.at(phrase.words[0], span[0]), "end": Anchor.at(phrase.words[-1], span[1])}
    return Movement(element, attributes, amount, anchors, span, lasting=True)


def _blinks(phrase: Phrase, random: Random) -> Iterator[Movement]:
    """A blink at most pauses; it closes the eyes whatever the liveliness is."""
    if phrase.pause >= _PAUSE and random.random() < _BLINKING:
        begin = phrase.end - 0.05
        anchors = {"start": Anchor.at(phrase.words[-1], begin)}
        yield Movement("faceLexeme", {"lexeme": "BLINK", "amount": "1"}, None, anchors, (begin, begin + 0.26))
