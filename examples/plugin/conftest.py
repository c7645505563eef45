"""Makes pytest explain failed assertions of contract tests."""

import pytest

pytest.register_assert_rewrite("reactive_realizer.testing")
