"""Hydraulics of the pump-controlled actuator: plain floats in, floats out; no MuJoCo, no files, no units but SI."""
