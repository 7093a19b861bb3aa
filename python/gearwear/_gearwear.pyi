from collections.abc import Callable, Sequence
from typing import Any

__version__: str

def main(arguments: Sequence[str]) -> int: ...
def check(text: str, name: str) -> None: ...
def put(text: str, name: str, key: str, value: str) -> str: ...
def moved(text: str, name: str, to: str) -> str: ...
def simulate(
    text: str,
    name: str,
    names: Sequence[str],
    theta: bytes,
    jacobian: bool,
    progress: Callable[[int, int], object] | None,
) -> dict[str, Any]: ...
