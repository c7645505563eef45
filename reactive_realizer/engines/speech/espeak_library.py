"""Calls espeak-ng by its C interface (speak_lib.h of espeak-ng 1.52); only the worker process may import this."""

import ctypes
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import espeakng_loader

_SYNCHRONOUS_RETRIEVAL = 2
_PHONEME_EVENTS, _PHONEME_IPA, _DONT_EXIT = 0x1, 0x2, 0x8000
_UTF8, _SSML = 0x1, 0x10
_LIST_TERMINATED, _WORD, _MARK, _PHONEME = 0, 1, 3, 7


class _EventId(ctypes.Union):
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("symbol", ctypes.c_char * 8))


class _Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _EventId),
    )


class _Voice(ctypes.Structure):
    _fields_ = (
        ("name", ctypes.c_char_p),
        ("languages", ctypes.c_char_p),
        ("identifier", ctypes.c_char_p),
        ("gender", ctypes.c_ubyte),
        ("age", ctypes.c_ubyte),
        ("variant", ctypes.c_ubyte),
        ("unused", ctypes.c_ubyte),
        ("score", ctypes.c_int),
        ("spare", ctypes.c_void_p),
    )


_Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event))


@dataclass(frozen=True, slots=True)
class Spoken:
    """The output of the library for one document; times are in samples.

    Attributes:
        audio: mono int16 PCM.
        words: time, 1-based position in the document, and number of the first phoneme of each spoken word.
        marks: (name, time).
        phonemes: (time, IPA symbol).
    """

    audio: bytearray = field(default_factory=bytearray)
    words: list[tuple[int, int, int]] = field(default_factory=list)
    marks: list[tuple[str, int]] = field(default_factory=list)
    phonemes: list[tuple[int, str]] = field(default_factory=list)

    def add(self, event: Any) -> None:
        """Adds one event of the library."""
        if event.type == _WORD and event.length > 0:  # length 0: a pause at a bracket or quotation mark
            self.words.append((event.sample, event.text_position, len(self.phonemes)))
        elif event.type == _MARK:
            self.marks.append((event.id.name.decode(), event.sample))
        elif event.type == _PHONEME:
            self.phonemes.append((event.sample, _symbol(event)))


def _symbol(event: Any) -> str:
    """The symbol of a phoneme event: up to eight bytes of UTF-8, not terminated if there are eight."""
    symbol = ctypes.string_at(ctypes.addressof(event) + _Event.id.offset, 8)
    return symbol.split(b"\0")[0].decode(errors="ignore")


class EspeakError(Exception):
    """A function of the library returned an error status."""


class EspeakLibrary:
    """The initialized library, a singleton of its process.

    Attributes:
        sample_rate: sample rate of the audio, Hz.
    """

    def __init__(self) -> None:
        self._library = ctypes.CDLL(str(espeakng_loader.get_library_path()))
        self._library.espeak_ListVoices.restype = ctypes.POINTER(ctypes.POINTER(_Voice))
        data = str(Path(espeakng_loader.get_data_path()).parent).encode()
        options = _PHONEME_EVENTS | _PHONEME_IPA | _DONT_EXIT
        self.sample_rate: int = self._library.espeak_Initialize(_SYNCHRONOUS_RETRIEVAL, 0, data, options)
        _check("espeak_Initialize", min(self.sample_rate, 0))  # a negative status in place of a rate
        self._library.espeak_ng_SetRandSeed(1)  # the default seed, for breath, is the present second
        self._spoken = Spoken()
        self._callback = _Callback(self._collect)  # the library keeps only the pointer
        self._library.espeak_SetSynthCallback(self._callback)

    def voices(self) -> dict[str, str]:
        """The library's identifier of each voice by its common name, in lower case: ``en-us``, ``nl``."""
        identifiers = [(voice.identifier.decode(), voice.languages[1:].decode()) for voice in self._listed(None)]
        names = {identifier.rpartition("/")[2].lower(): identifier for identifier, _ in identifiers}
        return {language.lower(): identifier for identifier, language in identifiers} | names

    def variants(self) -> tuple[str, ...]:
        """The sorted names of the variants that any voice can have, such as ``f3`` in ``en-us+f3``."""
        wanted = _Voice(languages=b"variant")
        return tuple(sorted({voice.identifier.decode().rpartition("/")[2] for voice in self._listed(wanted)}))

    def synthesize(self, ssml: str, voice: str) -> Spoken:
        """Speaks an SSML document.

        Args:
            ssml: the document.
            voice: the library's identifier of a voice.

        Raises:
            EspeakError: the library refuses the voice or the document.
        """
        self._spoken = Spoken()
        _check("espeak_SetVoiceByName", self._library.espeak_SetVoiceByName(voice.encode()))
        text = ssml.encode() + b"\0"
        _check("espeak_Synth", self._library.espeak_Synth(text, len(text), 0, 1, 0, _UTF8 | _SSML, None, None))
        return self._spoken

    def _listed(self, wanted: _Voice | None) -> Iterator[Any]:
        listed = self._library.espeak_ListVoices(None if wanted is None else ctypes.byref(wanted))
        index = 0
        while listed[index]:
            yield listed[index].contents
            index += 1

    def _collect(self, audio: Any, samples: int, events: Any) -> int:
        """Receives audio and events from the library; the return value 0 tells it to continue."""
        if samples > 0:
            self._spoken.audio.extend(ctypes.string_at(audio, samples * 2))
        index = 0
        while events[index].type != _LIST_TERMINATED:
            self._spoken.add(events[index])
            index += 1
        return 0


def _check(function: str, status: int) -> None:
    if status != 0:
        raise EspeakError(f"{function}: {status}")
