"""The paper's results, claim by claim: what it says, what the running code says, and the verdict.

Each file holds one group of claims, a short function each; `evidence` computes what they are held against. Like the
analysis they need the extra `analysis`.
"""
