"""Settings for property tests that stand in a class to inherit from; needs Hypothesis."""

from hypothesis import HealthCheck, settings

inherited = settings(suppress_health_check=[HealthCheck.differing_executors], deadline=None)
"""One test, run by more than one class; a machine that is busy breaks no contract."""
