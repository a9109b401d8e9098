"""What the subcommands do, by their names."""

from ._command_cohort import cohort as cohort
from ._command_evaluate import evaluate as evaluate
from ._command_phantom import phantom as phantom
from ._command_segment import segment as segment
from ._command_series import series as series
from ._command_surfaces import surfaces as surfaces
from ._command_trace import trace as trace
