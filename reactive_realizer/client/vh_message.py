"""Messages of the Virtual Human Toolkit: VHMSG, over ActiveMQ.

The text of a message is its first word, which selects it, and an argument, encoded as in a form of HTML (UTF-8). Some
programs do not encode it. Feedback of SmartBody has no first word: it is an XML element.
"""

import re
from typing import Final, NamedTuple
from urllib.parse import quote_plus, unquote_plus

SCOPE: Final = "DEFAULT_SCOPE"
"""The usual scope of messages."""


class VhMessage(NamedTuple):
    """A message: its first word, and the rest, decoded; of an XML element, the whole element and nothing."""

    word: str
    argument: str = ""

    @classmethod
    def read(cls, text: str) -> "VhMessage":
        """The message in a text."""
        text = text.strip()
        if text.startswith("<"):
            return cls(text)
        word, _, argument = text.partition(" ")
        encoded = not re.search(r"[\s<]", argument)
        return cls(word, unquote_plus(argument) if encoded else argument)

    @property
    def text(self) -> str:
        """The message as it is sent."""
        return f"{self.word} {quote_plus(self.argument)}"

    def headers(self, scope: str) -> dict[str, str]:
        """The headers by which components select messages, for a scope."""
        return {"ELVISH_SCOPE": scope, "MESSAGE_PREFIX": self.word.partition(" ")[0]}
