//! Floor 6: the forward model. What a run hands over to those who write it down is plain data: [`result`].

pub mod result;
