"""What tests ask of a claim."""

from ars_mujoco.reproduce.claim import Claim


def ours(claim: Claim) -> list:
    """Our numbers of a claim, in order."""
    return [number.value for number in claim.ours]


def verdict(claim: Claim) -> str:
    return str(claim.verdict)
