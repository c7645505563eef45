"""So that an assertion of a contract says what it compared."""

import pytest

pytest.register_assert_rewrite("reactive_realizer.testing")
