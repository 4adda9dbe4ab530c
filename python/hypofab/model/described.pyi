"""Written by scripts/python_stub.py from the descriptions of the models."""

from hypofab.tensors import Array

class ParameterNames:
    phi_c: float
    """critical friction angle"""
    p_t: float
    """shift of stress: the model sees T - p_t 1"""
    h_s: float
    """granular hardness"""
    n: float
    """exponent of the compression law"""
    e_d0: float
    """void ratio of the densest packing at p = 0"""
    e_c0: float
    """critical void ratio at p = 0"""
    e_i0: float
    """void ratio of the loosest packing at p = 0"""
    alpha: float
    """exponent of the density factor f_d"""
    beta: float
    """exponent of the density factor f_e"""
    m_R: float
    """stiffness factor at reversal; <= 0.5: no intergranular strain"""
    m_T: float
    """stiffness factor at a 90 degree turn"""
    R: float
    """size of the elastic strain range, largest |delta|"""
    beta_r: float
    """exponent of the evolution of delta"""
    chi: float
    """exponent of the interpolation in rho"""
    K_w: float
    """bulk stiffness of pore water (UMAT only); 0: drained"""
    e_0: float
    """initial void ratio (UMAT only), see docs/umat.md"""

class VariableNames:
    delta: Array
    """intergranular strain"""
    void_ratio: float
    """void ratio"""

class RateNames:
    delta: Array
    """intergranular strain; of points (n,) or (n, 6)"""
    void_ratio: Array
    """void ratio; of points (n,) or (n, 6)"""
